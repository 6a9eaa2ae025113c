#pragma once

#include "kernel/model/vec3.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oriel::detail {

/// The rectangle that points take up in a plane.
struct Reach {
  double u0 = Box::kInfinity, u1 = -Box::kInfinity, v0 = Box::kInfinity, v1 = -Box::kInfinity;

  [[nodiscard]] bool is_empty() const { return u0 > u1 || v0 > v1; }
  [[nodiscard]] double area() const { return (u1 - u0) * (v1 - v0); }
  [[nodiscard]] bool holds(const Reach& r, double slack) const {
    return r.u0 >= u0 - slack && r.u1 <= u1 + slack && r.v0 >= v0 - slack && r.v1 <= v1 + slack;
  }
  [[nodiscard]] Reach common(const Reach& r) const {
    return {std::max(u0, r.u0), std::min(u1, r.u1), std::max(v0, r.v0), std::min(v1, r.v1)};
  }
};

/// Two directions in a plane; `u` is level unless the plane is.
struct ReachAxes {
  Vec3 u, v;

  [[nodiscard]] Reach reach_of(const std::vector<Vec3>& points) const {
    Reach reach;
    for (const Vec3 p : points) grow(reach, p);
    return reach;
  }
  void grow(Reach& reach, Vec3 p) const {
    const double along_u = dot(p, u), along_v = dot(p, v);
    reach.u0 = std::min(reach.u0, along_u);
    reach.u1 = std::max(reach.u1, along_u);
    reach.v0 = std::min(reach.v0, along_v);
    reach.v1 = std::max(reach.v1, along_v);
  }
};

inline ReachAxes axes_in(Vec3 normal) {
  const Vec3 any = std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalised(cross(any, normal));
  return {u, cross(normal, u)};
}

}  // namespace oriel::detail
