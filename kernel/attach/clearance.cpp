#include "kernel/attach/clearance.h"

#include "kernel/geometry/planar.h"

#include <algorithm>

namespace oriel::detail {

double distance(std::pair<Vec3, Vec3> p, std::pair<Vec3, Vec3> q) {
  const Vec3 u = p.second - p.first, v = q.second - q.first, w = p.first - q.first;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double det = uu * vv - uv * uv;
  if (det > 0) {
    const double s = (uv * vw - vv * uw) / det, t = (uu * vw - uv * uw) / det;
    if (s > 0 && s < 1 && t > 0 && t < 1) return length(w + s * u - t * v);
  }
  return std::min({distance_to_segment(p.first, q.first, q.second),
                   distance_to_segment(p.second, q.first, q.second),
                   distance_to_segment(q.first, p.first, p.second),
                   distance_to_segment(q.second, p.first, p.second)});
}

}  // namespace oriel::detail
