#pragma once

#include "kernel/model/vec3.h"

#include <array>
#include <vector>

namespace oriel::detail {

/// Triangles that cover a planar polygon with holes, counter-clockwise about `normal`, in a fixed
/// order. `rings` (the outer one first) index `points`; every vertex of a ring is one of a triangle
/// and no new one is made. Where edges cross, so that no such triangles exist, the outer ring's fan
/// from its first vertex is given.
///
/// A constrained Delaunay triangulation (CGAL) of the polygon seen along the axis nearest to its
/// normal: that leaves the coordinates as they are, and predicates are exact.
std::vector<std::array<int, 3>> triangulate(const std::vector<Vec3>& points,
                                            const std::vector<std::vector<int>>& rings,
                                            Vec3 normal);

}  // namespace oriel::detail
