#pragma once

#include "model/vec3.h"

#include <algorithm>

/// What is asked of axis-parallel boxes; their faces belong to them.
namespace oriel {

/// True if the point is in the box, or no further than `margin_m` outside along any axis.
constexpr bool contains(const Box& box, Vec3 p, double margin_m = 0) {
  return p.x >= box.min.x - margin_m && p.x <= box.max.x + margin_m &&
         p.y >= box.min.y - margin_m && p.y <= box.max.y + margin_m &&
         p.z >= box.min.z - margin_m && p.z <= box.max.z + margin_m;
}

/// True if `inner` does not reach out of `outer`.
constexpr bool is_within(const Box& inner, const Box& outer) {
  return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
         inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
}

/// True if the boxes meet, or come as near as `reach_m` along every axis.
constexpr bool overlap(const Box& p, const Box& q, double reach_m = 0) {
  return p.min.x <= q.max.x + reach_m && q.min.x <= p.max.x + reach_m &&
         p.min.y <= q.max.y + reach_m && q.min.y <= p.max.y + reach_m &&
         p.min.z <= q.max.z + reach_m && q.min.z <= p.max.z + reach_m;
}

/// How far the boxes are apart, 0 where they touch.
inline double distance_m(const Box& p, const Box& q) {
  const auto gap = [](double low, double high, double other_low, double other_high) {
    return std::max({0.0, low - other_high, other_low - high});
  };
  return length({gap(p.min.x, p.max.x, q.min.x, q.max.x), gap(p.min.y, p.max.y, q.min.y, q.max.y),
                 gap(p.min.z, p.max.z, q.min.z, q.max.z)});
}

/// What the boxes share; an empty box if they do not meet.
constexpr Box intersection(const Box& p, const Box& q) {
  if (!overlap(p, q)) return {};
  return {{std::max(p.min.x, q.min.x), std::max(p.min.y, q.min.y), std::max(p.min.z, q.min.z)},
          {std::min(p.max.x, q.max.x), std::min(p.max.y, q.max.y), std::min(p.max.z, q.max.z)}};
}

/// The box, its faces moved outwards by `by_m`; an empty one stays empty.
constexpr Box grown(const Box& box, double by_m) {
  if (box.is_empty()) return box;
  const Vec3 by{by_m, by_m, by_m};
  return {box.min - by, box.max + by};
}

constexpr double volume_m3(const Box& box) {
  if (box.is_empty()) return 0;
  const Vec3 sides = box.max - box.min;
  return sides.x * sides.y * sides.z;
}

/// The volume that the boxes share by that of both together, 0 … 1.
constexpr double intersection_over_union(const Box& p, const Box& q) {
  const double shared = volume_m3(intersection(p, q));
  const double all = volume_m3(p) + volume_m3(q) - shared;
  return all > 0 ? shared / all : 0;
}

}  // namespace oriel
