#pragma once

#include "kernel/base/issue.h"
#include "kernel/model/scale_series.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// The states of the buildings `ids` in a file of a series, or in a line of a stream, whose
/// transform is in its `header`: the solid of each of the level of detail `lod`, empty: of the
/// highest, its semantic surfaces, the installations among its children, and its counts
/// `oriel_removed_…`. E120 and no value if a building is not there, or not as oriel writes a level.
Checked<std::vector<LevelState>> read_level(std::string_view text, const std::string& file,
                                            const std::vector<std::string>& ids,
                                            std::string_view header = {},
                                            const std::string& lod = {});

}  // namespace oriel
