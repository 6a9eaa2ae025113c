#pragma once

#include "model/vec3.h"

#include <array>
#include <span>
#include <vector>

namespace oriel::detail {

/// The plane for which the sum of squared distances of the points is least.
struct FittedPlane {
  Vec3 centre;
  /// Of length 1; across the line if all points are on one.
  Vec3 normal;

  [[nodiscard]] double distance(Vec3 point) const { return dot(normal, point - centre); }
};

/// `points` must not be empty.
FittedPlane fit_plane(std::span<const Vec3> points);

/// The triangles of a polygon in the plane fitted to its outer ring, into which its points are
/// turned: as val3dity makes them. triangulate() says what `rings` are and what is returned; the
/// order of triangles and where of two diagonals of the same length either would do may differ.
std::vector<std::array<int, 3>> triangulate_in_plane(const std::vector<Vec3>& points,
                                                     const std::vector<std::vector<int>>& rings);

}  // namespace oriel::detail
