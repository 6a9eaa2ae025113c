#include "kernel/solidify/planes/nearest_point.h"

namespace oriel::detail {

namespace {

/// From `start` to the point with the least sum of squared distances to `planes`, drawn back by
/// `pull` where they leave it free.
Vec3 least_squares_shift(const std::vector<Plane>& planes, Vec3 start, double pull) {
  double m[3][3] = {{pull, 0, 0}, {0, pull, 0}, {0, 0, pull}};
  Vec3 right;
  for (const Plane& plane : planes) {
    const double n[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] += n[i] * n[j];
    right = right + (plane.offset_m - dot(plane.normal, start)) * plane.normal;
  }
  const Vec3 r0{m[0][0], m[0][1], m[0][2]}, r1{m[1][0], m[1][1], m[1][2]},
      r2{m[2][0], m[2][1], m[2][2]};
  const double det = dot(r0, cross(r1, r2));
  return (1 / det) * (right.x * cross(r1, r2) + right.y * cross(r2, r0) + right.z * cross(r0, r1));
}

}  // namespace

Vec3 nearest_point(const std::vector<Plane>& planes, Vec3 start, double reach) {
  // Tolerances of nothing: they only keep the system regular along free directions.
  constexpr double kWeakest = 1e-4, kStrongest = 1;
  for (double pull = kWeakest; pull <= kStrongest; pull *= 10) {
    const Vec3 shift = least_squares_shift(planes, start, pull);
    if (length(shift) <= reach) return start + shift;
  }
  return start;
}

}  // namespace oriel::detail
