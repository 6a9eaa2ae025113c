#pragma once

#include "kernel/model/vec3.h"

#include <span>

namespace oriel::detail {

/// The least area that caps in these planes (unit normals, no more than four) have together if they
/// close a surface. `open` is the sum of area × unit normal over the surface's facets, which closed
/// surfaces have none of: the caps' own is the same, each cap's area positive. Infinite if no caps
/// close it. Areas are told apart by more than `slack_m2`: facets may be that much off their
/// planes.
double least_cap_area(std::span<const Vec3> normals, Vec3 open, double slack_m2);

}  // namespace oriel::detail
