#include "kernel/describe/features/shape.h"

#include "kernel/base/index.h"
#include "kernel/geometry/outlines.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

namespace {

/// A point or direction in plan.
struct InPlan {
  double x = 0, y = 0;

  friend InPlan operator-(InPlan p, InPlan q) { return {p.x - q.x, p.y - q.y}; }
  friend bool operator==(InPlan, InPlan) = default;
};

/// Of most features all points fit without memory of their own.
using PlanPoints = boost::container::small_vector<InPlan, 32>;

/// The convex hull in plan, counter-clockwise (Andrew's monotone chain); it stands in `points` or
/// `hull`, which are empty before.
std::span<const InPlan> hull_in_plan(std::span<const Vec3> of, PlanPoints& points,
                                     PlanPoints& hull) {
  points.reserve(of.size());
  for (const Vec3 p : of) points.push_back({p.x, p.y});
  std::ranges::sort(points, [](InPlan p, InPlan q) { return p.x != q.x ? p.x < q.x : p.y < q.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {points.data(), points.size()};
  hull.reserve(2 * points.size());
  const auto turn = [](InPlan p, InPlan q) { return p.x * q.y - p.y * q.x; };
  const auto add_half = [&](auto from, auto to) {
    const std::size_t begin = hull.size();
    for (auto p = from; p != to; ++p) {
      while (hull.size() > begin + 1 &&
             turn(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    // The last point is the first one of the other half.
    hull.pop_back();
  };
  add_half(points.begin(), points.end());
  add_half(points.rbegin(), points.rend());
  return {hull.data(), hull.size()};
}

/// The hull of points whose box in plan has a point in all its corners, without looking for it:
/// those corners, in the order of hull_in_plan(). So stand most features. None if the points are no
/// such ones.
std::span<const InPlan> corners_of_box(std::span<const Vec3> points, const Box& box,
                                       std::array<InPlan, 4>& corners) {
  unsigned found = 0;  // low and high x at low y, then at high y
  for (const Vec3& p : points) {
    const unsigned in_x = unsigned{p.x == box.min.x} + 2 * unsigned{p.x == box.max.x};
    found |= in_x * (unsigned{p.y == box.min.y} + 4 * unsigned{p.y == box.max.y});
  }
  constexpr unsigned kAllFour = 15;
  if (found != kAllFour) return {};
  const bool is_wide = box.min.x < box.max.x, is_deep = box.min.y < box.max.y;
  std::size_t count = 0;
  corners[count++] = {box.min.x, box.min.y};
  if (is_wide) corners[count++] = {box.max.x, box.min.y};
  if (is_deep) corners[count++] = {box.max.x, box.max.y};
  if (is_wide && is_deep) corners[count++] = {box.min.x, box.max.y};
  return {corners.data(), count};
}

/// The extents of points in plan along a direction and across it.
std::pair<double, double> sizes_along(std::span<const InPlan> points, InPlan u) {
  Extent along, across;
  for (const InPlan& p : points) {
    const double s = p.x * u.x + p.y * u.y, t = p.x * -u.y + p.y * u.x;
    along.low = std::min(along.low, s);
    along.high = std::max(along.high, s);
    across.low = std::min(across.low, t);
    across.high = std::max(across.high, t);
  }
  return {along.size(), across.size()};
}

}  // namespace

std::array<double, 3> StandingBox::edges() const {
  std::array<double, 3> sorted{length, breadth, height};
  std::ranges::sort(sorted, std::greater{});
  return sorted;
}

StandingBox standing_box(std::span<const Vec3> points) {
  Box box;
  for (const Vec3& p : points) box.grow(p);
  StandingBox best;
  best.height = box.max.z - box.min.z;
  best.along = {1, 0, 0};
  std::array<InPlan, 4> corners;
  PlanPoints in_plan, of_hull;
  std::span<const InPlan> hull = corners_of_box(points, box, corners);
  std::size_t sides = (hull.size() + 1) / 2;  // opposite sides of a box say the same
  if (hull.empty()) {
    hull = hull_in_plan(points, in_plan, of_hull);
    sides = hull.size();
  }
  double least = Box::kInfinity;
  // One side of the smallest rectangle lies along a side of the hull.
  for (std::size_t i = 0; i < sides; ++i) {
    const InPlan side = hull[i + 1 < hull.size() ? i + 1 : 0] - hull[i];
    if (side.x == 0 && side.y == 0) continue;
    const Vec3 u = normalised({side.x, side.y, 0}), v{-u.y, u.x, 0};
    const auto [along, across] = sizes_along(hull, {u.x, u.y});
    if (along * across >= least) continue;
    least = along * across;
    best.length = std::max(along, across);
    best.breadth = std::min(along, across);
    best.along = along >= across ? u : v;
  }
  return best;
}

Extent extent_along(std::span<const Vec3> points, Vec3 direction) {
  Extent extent;
  for (const Vec3& p : points) {
    extent.low = std::min(extent.low, dot(p, direction));
    extent.high = std::max(extent.high, dot(p, direction));
  }
  return extent;
}

std::vector<Vec3> points_of(const Segmentation& segmentation, const Feature& feature) {
  std::vector<Vec3> points;
  points.reserve(feature.vertices.size());
  for (const int v : feature.vertices) points.push_back(segmentation.vertices[at(v)].point);
  return points;
}

std::vector<Vec3> points_of(const Segmentation& segmentation, const Cell& cell) {
  std::vector<Vec3> points;
  for (const Facet& facet : cell.facets)
    for (const Loop& loop : facet.loops)
      for (const int v : loop) points.push_back(segmentation.vertices[at(v)].point);
  return points;
}

std::vector<std::vector<Vec3>> facet_outlines(const Segmentation& segmentation,
                                              const CellFacet& facet) {
  return outlines_of(segmentation.vertices,
                     segmentation.cells[facet.cell.index()].facets[at(facet.facet)].loops);
}

}  // namespace oriel::detail
