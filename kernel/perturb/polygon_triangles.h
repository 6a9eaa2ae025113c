#pragma once

#include "kernel/base/random.h"
#include "model/vec3.h"
#include "model/whole_point.h"

#include <array>
#include <functional>
#include <vector>

namespace oriel::detail {

/// Cuts a polygon in space into triangles without new corners, in a random way (clip_ears): numbers
/// of its vertices, turned as it is. Nothing if that cannot be done, as rings cross or touch.
/// `rings` are the outer ring, counter-clockwise about `normal`, of any length, and the holes.
/// `place_of` says where a vertex is.
std::vector<std::array<int, 3>> polygon_triangles(
    const std::vector<std::vector<int>>& rings, Vec3 normal,
    const std::function<MicrometrePoint(int)>& place_of, Random& random);

}  // namespace oriel::detail
