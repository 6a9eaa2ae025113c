#pragma once

#include "kernel/base/random.h"
#include "kernel/model/building.h"

#include <vector>

namespace oriel::detail {

/// The triangles of a polygon, each with all that the polygon has besides its rings; the polygon
/// itself if it is a triangle or cannot be cut. Decided on whole micrometres.
std::vector<Polygon> triangulated(const std::vector<Vec3>& vertices, const Polygon& polygon,
                                  Random& random);

}  // namespace oriel::detail
