#include "kernel/attach/clearance.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oriel {

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

double nearness(std::span<const Vec3> outline, std::pair<Vec3, Vec3> edge) {
  double near_m = Box::kInfinity;
  for (std::size_t i = 0; i < outline.size(); ++i)
    near_m = std::min(near_m, distance({outline[i], outline[(i + 1) % outline.size()]}, edge));
  return near_m;
}

double needed_m(const Clearance& clearance, std::pair<Vec3, Vec3> edge) {
  constexpr double kAsNear_m = kLeastEdge_m / 2;
  double near_m = clearance.least_m;
  for (const auto& outline : clearance.before)
    near_m = std::min(near_m, nearness(outline, edge) - kAsNear_m);
  return std::max(near_m, kLeastEdge_m);
}

bool is_too_near(const Clearance& clearance, double near_m, std::pair<Vec3, Vec3> edge) {
  return near_m < std::max(clearance.least_m, kLeastEdge_m) && near_m < needed_m(clearance, edge);
}

namespace {

/// The box that the facet passes through, in its own axes.
std::vector<HalfSpaceM> passage(const Solid& solid, FacetId facet, const Moves& moves) {
  const Vec3 n = solid.planes[solid.facets[facet.index()].plane.index()].normal;
  const auto [u, v] = axes_in(n);
  std::vector<HalfSpaceM> limits;
  for (const Vec3 direction : {u, -u, v, -v, n, -n}) {
    HalfSpaceM limit{direction, -Box::kInfinity};
    for (const auto& [vertex, to] : moves)
      limit.offset_m = std::max(
          {limit.offset_m, dot(direction, solid.vertices[at(vertex)].point), dot(direction, to)});
    limits.push_back(limit);
  }
  for (std::size_t along = 4; along < limits.size(); ++along)
    limits[along].offset_m += kLeastEdge_m;
  return limits;
}

}  // namespace

bool is_in_the_way(const Solid& solid, FacetId facet, const Moves& moves) {
  const auto limits = passage(solid, facet, moves);
  const auto is_within = [&](int v) {
    return std::ranges::all_of(limits, [&](const HalfSpaceM& limit) {
      return dot(limit.normal, solid.vertices[at(v)].point) <= limit.offset_m;
    });
  };
  for (const FacetId f : ids_below<FacetId>(solid.facets.size())) {
    if (f == facet) continue;
    const Facet& other = solid.facets[f.index()];
    bool is_beside = false;
    for (const Loop& loop : other.loops)
      for (const int v : loop) {
        if (moves.contains(v))
          is_beside = true;
        else if (is_within(v))
          return true;
      }
    const Vec3 normal = solid.planes[other.plane.index()].normal;
    if (!is_beside && area_within(solid.vertices, other, normal, limits) > kTouch_m2) return true;
  }
  return false;
}

}  // namespace oriel
