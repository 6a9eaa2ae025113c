#pragma once

#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/solids/predicates.h"

#include <array>

namespace oriel::detail {

using TriangleCorners = std::array<int, 3>;

MicrometreTriangle points_of(const SnappedBuilding& building, const TriangleCorners& corners);

/// True if triangles that share an edge, p and q their other corners, lie on each other.
bool fold_back(const SnappedBuilding& building, const TriangleCorners& a, int p, int q);

/// True if two triangles have more in common than their common corners and edges.
bool intersect(const SnappedBuilding& building, TriangleCorners a, TriangleCorners b);

}  // namespace oriel::detail
