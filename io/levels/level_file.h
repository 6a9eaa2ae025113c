#pragma once

#include "io/document.h"
#include "kernel/base/issue.h"
#include "model/scale_series.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// The states of the buildings `ids` in a file of a series, or in a line of a stream, whose
/// transform is in its `header`: the geometry of each of the level of detail `lod`, empty: of the
/// highest, a solid before surfaces, its semantic surfaces, the installations among its children,
/// and the attributes of its state (is_of_state). One with `oriel_member_of` has no facets. E120
/// and no value if a building is not there, or not as oriel writes a level.
Checked<std::vector<LevelState>> read_level(std::string_view text, const std::string& file,
                                            const std::vector<std::string>& ids,
                                            std::string_view header = {},
                                            const std::string& lod = {});

/// The state of a building of a document as it was read, in the same way: with all polygons that
/// have an outer ring of their own. Throws GeometryError if its text is no such.
LevelState state_as_read(const Document& document, const Building& building);

}  // namespace oriel
