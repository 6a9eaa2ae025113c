#pragma once

#include "model/vec3.h"

#include <array>
#include <vector>

namespace oriel {

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

/// The same triangles but for a quadrangle without a corner that is straight or turned inwards: it
/// is cut along the diagonal from its first vertex, which is quicker than to find out which one is
/// Delaunay's (both, in a rectangle). For what shows or measures the surface only.
std::vector<std::array<int, 3>> triangulate_quickly(const std::vector<Vec3>& points,
                                                    const std::vector<std::vector<int>>& rings,
                                                    Vec3 normal);

}  // namespace oriel
