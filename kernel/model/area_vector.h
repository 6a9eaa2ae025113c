#pragma once

#include "kernel/model/vec3.h"

#include <concepts>
#include <cstddef>
#include <span>

/// The area vector of a closed ring (Newell): along its normal, from which the ring is seen
/// counter-clockwise, and as long as its area. That of a ring with less than three points is zero.
namespace oriel {

/// Adds twice the area vector of the ring of the points point_at(0) … point_at(size - 1) to `sum`.
template <std::invocable<std::size_t> PointAt>
void add_doubled_area(Vec3& sum, std::size_t size, PointAt point_at) {
  if (size < 3) return;
  const Vec3 base = point_at(0);
  for (std::size_t i = 1; i + 1 < size; ++i)
    sum = sum + cross(point_at(i) - base, point_at(i + 1) - base);
}

template <std::invocable<std::size_t> PointAt>
Vec3 area_vector(std::size_t size, PointAt point_at) {
  Vec3 doubled;
  add_doubled_area(doubled, size, point_at);
  return 0.5 * doubled;
}

inline Vec3 area_vector(std::span<const Vec3> ring) {
  return area_vector(ring.size(), [&](std::size_t i) { return ring[i]; });
}

/// Of a ring of numbers of points.
inline Vec3 area_vector(std::span<const Vec3> points, std::span<const int> ring) {
  return area_vector(ring.size(),
                     [&](std::size_t i) { return points[static_cast<std::size_t>(ring[i])]; });
}

}  // namespace oriel
