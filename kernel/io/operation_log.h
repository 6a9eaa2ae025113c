#pragma once

#include "kernel/model/issue.h"
#include "kernel/model/scale_series.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// One line of `NAME.oplog.jsonl`, with its line end: building, oriel_id, label, operation, rule,
/// scale, with, aabb, forward, inverse (docs/formats.md). Points are in the input's coordinates, to
/// the micrometre; aabb = [xmin, ymin, zmin, xmax, ymax, zmax].
std::string operation_line(const SeriesOperation& operation);

/// The operations of such a text, in their order. E119 for a line that is none, with its number;
/// then there is no value.
Checked<std::vector<SeriesOperation>> read_operations(std::string_view text,
                                                      const std::string& file);

}  // namespace oriel
