#pragma once

#include "model/vec3.h"

#include <algorithm>

namespace oriel::test {

inline double volume_of(const Box& box) {
  const Vec3 size = box.max - box.min;
  return std::max(0.0, size.x) * std::max(0.0, size.y) * std::max(0.0, size.z);
}

/// The volume of the intersection of two boxes by that of their union.
inline double iou_of(const Box& p, const Box& q) {
  const Box both{
      {std::max(p.min.x, q.min.x), std::max(p.min.y, q.min.y), std::max(p.min.z, q.min.z)},
      {std::min(p.max.x, q.max.x), std::min(p.max.y, q.max.y), std::min(p.max.z, q.max.z)}};
  const double shared = volume_of(both);
  return shared / (volume_of(p) + volume_of(q) - shared);
}

}  // namespace oriel::test
