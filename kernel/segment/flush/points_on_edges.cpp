#include "kernel/segment/flush/points_on_edges.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace oriel::detail {

PointsOnEdges::PointsOnEdges(const std::vector<Vec3>& points, ReachAxes axes, double slack_m)
    : points_(points),
      axes_(axes),
      slack_m_(slack_m),
      by_u_(strip_along(axes.u)),
      by_v_(strip_along(axes.v)) {}

PointsOnEdges::Strip PointsOnEdges::strip_along(Vec3 axis) const {
  Strip strip;
  strip.points.resize(points_.size());
  std::iota(strip.points.begin(), strip.points.end(), 0);
  const auto coordinate = [&](int p) { return dot(points_[at(p)], axis); };
  std::ranges::stable_sort(strip.points, {}, coordinate);
  for (const int p : strip.points) strip.coordinates.push_back(coordinate(p));
  return strip;
}

std::pair<std::size_t, std::size_t> PointsOnEdges::Strip::range(double low, double high) const {
  const auto first = std::ranges::lower_bound(coordinates, low);
  const auto past = std::ranges::upper_bound(coordinates, high);
  return {static_cast<std::size_t>(first - coordinates.begin()),
          static_cast<std::size_t>(past - coordinates.begin())};
}

std::vector<int> PointsOnEdges::between(int from, int to) const {
  const Vec3 start = points_[at(from)], along = points_[at(to)] - start;
  const auto range_along = [&](const Strip& strip, Vec3 axis) {
    const double p = dot(start, axis), q = p + dot(along, axis);
    return strip.range(std::min(p, q) - slack_m_, std::max(p, q) + slack_m_);
  };
  const auto u = range_along(by_u_, axes_.u), v = range_along(by_v_, axes_.v);
  const bool is_u_shorter = u.second - u.first < v.second - v.first;
  const Strip& strip = is_u_shorter ? by_u_ : by_v_;
  const auto [first, past] = is_u_shorter ? u : v;
  std::vector<std::pair<double, int>> found;
  const double square = dot(along, along);
  for (std::size_t i = first; i < past; ++i) {
    const int p = strip.points[i];
    if (p == from || p == to) continue;
    const Vec3 offset = points_[at(p)] - start;
    const double t = dot(offset, along) / square;
    if (t > 0 && t < 1 && length(offset - t * along) <= slack_m_) found.emplace_back(t, p);
  }
  std::ranges::sort(found);
  std::vector<int> between;
  for (const auto& [t, p] : found) between.push_back(p);
  return between;
}

}  // namespace oriel::detail
