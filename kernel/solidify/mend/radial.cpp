#include "kernel/solidify/mend/radial.h"

#include "kernel/base/index.h"

#include <algorithm>

namespace oriel::detail {

namespace {

using exact::GridPoint;
using exact::Int128;

int sign(Int128 value) { return (value > 0) - (value < 0); }

Normal negated(const Normal& n) { return {-n[0], -n[1], -n[2]}; }

/// (m × n) · axis, and (m · n)(axis · axis) − (m · axis)(n · axis): sine and cosine of the angle
/// from m to n round the axis, times the same positive number. Below 2^92 and 2^127.
Int128 sine(const Normal& m, const Normal& n, const GridPoint& axis) {
  return Int128{m[1] * n[2] - m[2] * n[1]} * axis[0] + Int128{m[2] * n[0] - m[0] * n[2]} * axis[1] +
         Int128{m[0] * n[1] - m[1] * n[0]} * axis[2];
}

Int128 cosine(const Normal& m, const Normal& n, const GridPoint& axis) {
  const std::int64_t mn = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
  return mn * exact::dot({axis[0], axis[1], axis[2]}, axis) -
         exact::dot(m, axis) * exact::dot(n, axis);
}

struct Ray {
  Spoke spoke;
  Normal normal;  ///< that a half-edge that runs up would have: it follows the ray round the edge
  int half = 0;   ///< 0: at an angle in [0, π) to the first ray, 1: in [π, 2π)
  int rank = 0;   ///< among rays of the same direction
};

}  // namespace

std::vector<Spoke> sort_round(const Soup& soup, const ShellMesh& mesh, const EdgeGroup& group,
                              const std::vector<PolygonShape>& shapes) {
  const std::size_t first = at(group[0]);
  const EdgeEnds ends(soup.corners[first], soup.corners[at(mesh.next[first])]);
  const auto &low = soup.points[at(ends.low)], &high = soup.points[at(ends.high)];
  const GridPoint axis{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::vector<Ray> rays;
  for (const int h : group) {
    const bool runs_up = soup.corners[at(h)] == ends.low;
    const int polygon = mesh.polygon_of[at(h)];
    const auto& own = shapes[at(polygon)].normal;
    const Normal normal = !own      ? rays.empty() ? Normal{} : rays[0].normal
                          : runs_up ? *own
                                    : negated(*own);
    // Behind its like if it shows the larger of its two normals, before it if not.
    const bool is_larger = normal > negated(normal);
    rays.push_back({{h, runs_up}, normal, 0, is_larger ? polygon : -polygon});
  }
  const Normal zero = rays[0].normal;
  for (Ray& ray : rays) {
    const int s = sign(sine(zero, ray.normal, axis));
    ray.half = s > 0 || (s == 0 && cosine(zero, ray.normal, axis) >= 0) ? 0 : 1;
  }
  std::ranges::sort(rays, [&](const Ray& p, const Ray& q) {
    if (p.half != q.half) return p.half < q.half;
    const int s = sign(sine(p.normal, q.normal, axis));
    if (s != 0) return s > 0;
    return p.rank != q.rank ? p.rank < q.rank : p.spoke.half_edge < q.spoke.half_edge;
  });
  std::vector<Spoke> spokes;
  for (const Ray& ray : rays) spokes.push_back(ray.spoke);
  return spokes;
}

}  // namespace oriel::detail
