#pragma once

#include "kernel/base/issue.h"
#include "kernel/model/building.h"
#include "kernel/model/repair.h"

#include <string>
#include <vector>

namespace oriel {

/// What became of one building as a line of JSON, with its line end (docs/formats.md, "Repair
/// report"). Places are in the input's coordinates, polygons numbers in reading order from 0.
/// `is_solid`: a solid could be made. `issues` are those of solidify.
std::string repair_json(const Building& building, bool is_solid, const RepairReport& report,
                        const std::vector<Issue>& issues);

}  // namespace oriel
