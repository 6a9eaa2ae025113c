#pragma once

#include "kernel/model/vec3.h"

#include <cmath>

namespace oriel::detail {

/// A directed piece of an outline in one plane. To its left, seen from the plane's front, `label`
/// begins to hold `count` times more.
struct Chord {
  int from = -1;
  int to = -1;
  int label = -1;
  int count = 1;
};

/// Labels say where a cell is: just in front of the plane, or just behind it.
constexpr int label_of(int cell, bool is_in_front) { return 2 * cell + (is_in_front ? 1 : 0); }
constexpr int cell_of(int label) { return label / 2; }
constexpr bool is_in_front(int label) { return label % 2 != 0; }

/// A point in a plane.
struct Vec2 {
  double x = 0, y = 0;

  friend constexpr Vec2 operator-(Vec2 p, Vec2 q) { return {p.x - q.x, p.y - q.y}; }
};

constexpr double dot(Vec2 p, Vec2 q) { return p.x * q.x + p.y * q.y; }
constexpr double cross(Vec2 p, Vec2 q) { return p.x * q.y - p.y * q.x; }
inline double length(Vec2 p) { return std::sqrt(dot(p, p)); }

/// Coordinates in a plane, counter-clockwise as seen from its front.
class PlaneAxes {
 public:
  explicit PlaneAxes(Vec3 normal)
      : x_(normalised(cross(std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal))),
        y_(cross(normal, x_)) {}

  [[nodiscard]] Vec2 operator()(Vec3 point) const { return {dot(x_, point), dot(y_, point)}; }

 private:
  Vec3 x_, y_;
};

}  // namespace oriel::detail
