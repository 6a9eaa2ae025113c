#pragma once

#include "kernel/model/vec3.h"

#include <span>

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

}  // namespace oriel::detail
