#pragma once

#include "io/objects/city_record.h"
#include "kernel/base/issue.h"

#include <vector>

namespace oriel::detail {

/// Makes a solid of each installation that shares polygons with the solid of its building, and
/// takes them from the building: faces, ClosureSurfaces, close both where they met, so that the two
/// bodies touch and no polygon is drawn twice. Each loop of the edge between them must lie in one
/// plane, or in two that a chord parts it into, to Tolerances::plane_offset_m, and none within
/// another; else the installation stays what it is, and a warning E166 says so.
std::vector<Issue> close_installations(CityRecord& record);

}  // namespace oriel::detail
