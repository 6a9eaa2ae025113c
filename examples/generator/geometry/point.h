#pragma once

#include "model/vec3.h"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel::generator {

/// A length in whole micrometres. Houses are laid out in whole millimetres with roof slopes in
/// thousandths, so every corner, on a slanted roof too, is a whole number of micrometres and every
/// face is planar without rounding.
using Um = std::int64_t;

constexpr Um operator""_mm(unsigned long long n) { return static_cast<Um>(n) * 1000; }
constexpr double metres(Um length) { return static_cast<double>(length) / 1e6; }

/// A corner, or a direction of length 1 along an axis; z up.
struct Point {
  Um x = 0, y = 0, z = 0;

  friend constexpr auto operator<=>(const Point&, const Point&) = default;
  friend constexpr Point operator+(Point p, Point q) { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
  friend constexpr Point operator-(Point p, Point q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
  friend constexpr Point operator-(Point p) { return {-p.x, -p.y, -p.z}; }
  friend constexpr Point operator*(Um s, Point p) { return {s * p.x, s * p.y, s * p.z}; }
};

constexpr Um dot(Point p, Point q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
/// Exact for vectors up to 2 km.
constexpr Point cross(Point p, Point q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
constexpr Vec3 metres(Point p) { return {metres(p.x), metres(p.y), metres(p.z)}; }

/// A closed polyline; the first point is not repeated.
using Ring = std::vector<Point>;

/// A right-handed frame of axis-parallel directions. On a wall u runs to the right as seen from
/// outside, v up and w outwards; on a roof u runs along the eaves, v inwards (in plan), w up.
struct Frame {
  Point origin;
  Point u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};

  [[nodiscard]] constexpr Point at(Um a, Um b, Um c) const {
    return origin + a * u + b * v + c * w;
  }
  /// The coordinates of `p` in this frame.
  [[nodiscard]] constexpr Point coordinates_of(Point p) const {
    const Point d = p - origin;
    return {dot(d, u), dot(d, v), dot(d, w)};
  }
  /// The parallel frame whose origin stands at (a, b, c) of this one.
  [[nodiscard]] constexpr Frame moved(Um a, Um b, Um c) const { return {at(a, b, c), u, v, w}; }
  /// The same frame with its axes renamed: (u, v, w) of the result are (v, w, u) of this one.
  [[nodiscard]] constexpr Frame turned() const { return {origin, v, w, u}; }
};

/// A position in the (u, v) plane of a frame.
struct Uv {
  Um u = 0, v = 0;
};

/// A rectangle in the (u, v) plane of a frame.
struct Rect {
  Um u0 = 0, u1 = 0, v0 = 0, v1 = 0;

  [[nodiscard]] constexpr Um width() const { return u1 - u0; }
  [[nodiscard]] constexpr Um height() const { return v1 - v0; }
  [[nodiscard]] constexpr Um middle() const { return (u0 + u1) / 2; }
  [[nodiscard]] constexpr Rect grown(Um by) const { return {u0 - by, u1 + by, v0 - by, v1 + by}; }
  [[nodiscard]] constexpr Rect moved(Um du, Um dv) const {
    return {u0 + du, u1 + du, v0 + dv, v1 + dv};
  }
  /// True if the two share more than a border.
  [[nodiscard]] constexpr bool overlaps(const Rect& other) const {
    return u0 < other.u1 && other.u0 < u1 && v0 < other.v1 && other.v0 < v1;
  }
  [[nodiscard]] constexpr bool contains(const Rect& other) const {
    return u0 <= other.u0 && other.u1 <= u1 && v0 <= other.v0 && other.v1 <= v1;
  }
  friend constexpr bool operator==(const Rect&, const Rect&) = default;
};

}  // namespace oriel::generator
