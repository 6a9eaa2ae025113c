#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>

namespace oriel {

/// A point or direction; metres in the frame of a building (z up) unless a name says otherwise.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  friend constexpr Vec3 operator+(Vec3 p, Vec3 q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
  friend constexpr Vec3 operator-(Vec3 p, Vec3 q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  /// Of 0 makes 0, not -0, so that it prints well.
  friend constexpr Vec3 operator-(Vec3 p) { return {0 - p.x, 0 - p.y, 0 - p.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 p) { return {s * p.x, s * p.y, s * p.z}; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 p, Vec3 q) { return p.x * q.x + p.y * q.y + p.z * q.z; }

constexpr Vec3 cross(Vec3 p, Vec3 q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

inline double length(Vec3 p) { return std::sqrt(dot(p, p)); }

/// `p` scaled to length 1; the zero vector stays zero.
inline Vec3 normalised(Vec3 p) {
  const double size = length(p);
  return size > 0 ? (1 / size) * p : p;
}

/// An axis-parallel box. The default is empty: min > max, and growing it by a point makes it that
/// point.
struct Box {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 min{kInfinity, kInfinity, kInfinity};
  Vec3 max{-kInfinity, -kInfinity, -kInfinity};

  [[nodiscard]] constexpr bool is_empty() const { return min.x > max.x; }

  constexpr void grow(Vec3 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  constexpr void grow(const Box& box) {
    if (box.is_empty()) return;
    grow(box.min);
    grow(box.max);
  }
  /// The box moved by `shift`.
  [[nodiscard]] constexpr Box moved(Vec3 shift) const { return {min + shift, max + shift}; }
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// Adds twice the area vector of the ring of the points point_at(0) … point_at(size - 1) to `sum`.
template <std::invocable<std::size_t> PointAt>
void add_doubled_area(Vec3& sum, std::size_t size, PointAt point_at) {
  if (size < 3) return;
  const Vec3 base = point_at(0);
  for (std::size_t i = 1; i + 1 < size; ++i)
    sum = sum + cross(point_at(i) - base, point_at(i + 1) - base);
}

/// The area vector of a closed ring (Newell): along its normal, from which the ring is seen
/// counter-clockwise, and as long as its area. That of a ring with less than three points is zero.
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
