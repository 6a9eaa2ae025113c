#include "kernel/geometry/planar.h"

#include "model/vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <boost/container/small_vector.hpp>

namespace oriel {

namespace {

/// The two axes that are left when the normal's largest one is dropped.
struct Axes {
  double Vec3::*u;
  double Vec3::*v;
  double Vec3::*dropped;
};

Axes axes_for(Vec3 normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (z >= x && z >= y) return {&Vec3::x, &Vec3::y, &Vec3::z};
  if (y >= x) return {&Vec3::x, &Vec3::z, &Vec3::y};
  return {&Vec3::y, &Vec3::z, &Vec3::x};
}

template <class Points, class Visit>
void for_each_edge(std::span<const Points> outlines, Visit visit) {
  for (const Points& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      visit(outline[i], outline[i + 1 < outline.size() ? i + 1 : 0]);
}

/// Of most figures all numbers fit without memory of their own.
using FewNumbers = boost::container::small_vector<double, 32>;

/// Where the line v = level cuts the outlines, sorted along u.
template <class Points>
FewNumbers crossings(std::span<const Points> outlines, const Axes& axes, double level) {
  FewNumbers cuts;
  for_each_edge(outlines, [&](Vec3 p, Vec3 q) {
    if ((p.*axes.v > level) == (q.*axes.v > level)) return;
    const double t = (level - p.*axes.v) / (q.*axes.v - p.*axes.v);
    cuts.push_back(p.*axes.u + t * (q.*axes.u - p.*axes.u));
  });
  std::ranges::sort(cuts);
  return cuts;
}

/// A point in the middle of the longest chord of the figure at a level; nothing if there is none.
template <class Points>
std::optional<Vec3> point_at(std::span<const Points> outlines, Vec3 normal, const Axes& axes,
                             double level) {
  const FewNumbers cuts = crossings(outlines, axes, level);
  double longest = kThin_m;
  std::optional<Vec3> point;
  for (std::size_t i = 1; i < cuts.size(); i += 2) {
    if (cuts[i] - cuts[i - 1] <= longest) continue;
    longest = cuts[i] - cuts[i - 1];
    point = Vec3{};
    (*point).*axes.u = (cuts[i] + cuts[i - 1]) / 2;
    (*point).*axes.v = level;
  }
  if (!point) return std::nullopt;
  const auto any = std::ranges::find_if_not(outlines, &Points::empty);
  const double missing = dot(any->front(), normal) - dot(*point, normal);
  (*point).*axes.dropped = missing / (normal.*axes.dropped);
  return point;
}

/// From one of some ascending levels to the next, and half of the way.
double gap_above(const FewNumbers& levels, std::size_t i) {
  return i + 1 < levels.size() ? levels[i + 1] - levels[i] : 0;
}
double middle_above(const FewNumbers& levels, std::size_t i) {
  return (levels[i + 1] + levels[i]) / 2;
}

/// The levels with a gap above them, the tallest first.
std::vector<std::size_t> by_falling_gap(const FewNumbers& levels) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i)
    if (levels[i + 1] > levels[i]) order.push_back(i);
  std::ranges::stable_sort(order, std::greater{},
                           [&](std::size_t i) { return gap_above(levels, i); });
  return order;
}

template <class Points>
std::optional<Vec3> point_inside_of(std::span<const Points> outlines, Vec3 normal) {
  const Axes axes = axes_for(normal);
  FewNumbers levels;
  for (const Points& outline : outlines)
    for (const Vec3 p : outline) levels.push_back(p.*axes.v);
  std::ranges::sort(levels);
  // The middle of the tallest gap between vertices: the line there meets no vertex. Where outlines
  // run over each other there is nothing inside, and the next gap is tried.
  std::size_t tallest = 0;
  for (std::size_t i = 1; i < levels.size(); ++i)
    if (levels[i] - levels[i - 1] > gap_above(levels, tallest)) tallest = i - 1;
  if (gap_above(levels, tallest) <= 0) return std::nullopt;
  if (const auto point = point_at(outlines, normal, axes, middle_above(levels, tallest)))
    return point;
  for (const std::size_t i : by_falling_gap(levels))
    if (const auto point = point_at(outlines, normal, axes, middle_above(levels, i))) return point;
  return std::nullopt;
}

/// contains() for the axes that are left.
template <double Vec3::*kU, double Vec3::*kV>
bool contains_along(std::span<const Outline> outlines, Vec3 point) {
  bool is_inside = false;
  for (const Outline& outline : outlines) {
    if (outline.empty()) continue;
    const Vec3* p = &outline.back();
    bool is_above = p->*kV > point.*kV;
    for (const Vec3& q : outline) {
      const bool was_above = std::exchange(is_above, q.*kV > point.*kV);
      const Vec3& from = *std::exchange(p, &q);
      if (was_above == is_above) continue;
      const double t = (point.*kV - from.*kV) / (q.*kV - from.*kV);
      if (point.*kU < from.*kU + t * (q.*kU - from.*kU)) is_inside = !is_inside;
    }
  }
  return is_inside;
}

/// The signed solid angle of a triangle seen from the origin, after Van Oosterom & Strackee 1983.
double solid_angle(Vec3 p, Vec3 q, Vec3 r) {
  const double lp = length(p), lq = length(q), lr = length(r);
  return 2 * std::atan2(dot(p, cross(q, r)),
                        lp * lq * lr + dot(p, q) * lr + dot(q, r) * lp + dot(r, p) * lq);
}

}  // namespace

double signed_area(const Outline& outline, Vec3 normal) {
  return dot(area_vector(outline), normal);
}

void start_at_least(Outline& outline) {
  const auto least = std::ranges::min_element(outline, is_lesser);
  if (least != outline.begin()) std::ranges::rotate(outline, least);
}

double perimeter(const Outline& outline) {
  double sum = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    sum += length(outline[i + 1 < outline.size() ? i + 1 : 0] - outline[i]);
  return sum;
}

bool contains(std::span<const Outline> outlines, Vec3 normal, Vec3 point) {
  const Axes axes = axes_for(normal);
  if (axes.dropped == &Vec3::z) return contains_along<&Vec3::x, &Vec3::y>(outlines, point);
  if (axes.dropped == &Vec3::y) return contains_along<&Vec3::x, &Vec3::z>(outlines, point);
  return contains_along<&Vec3::y, &Vec3::z>(outlines, point);
}

bool contains_clearly(std::span<const Outline> outlines, Vec3 normal, Vec3 point, double margin_m) {
  for (const Outline& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      if (distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]) <= margin_m)
        return false;
  return contains(outlines, normal, point);
}

bool do_cross(Vec3 a, Vec3 b, Vec3 c, Vec3 d, Vec3 normal, double slack_m) {
  const auto side = [&](Vec3 from, Vec3 to, Vec3 of) {
    const double area = dot(cross(to - from, of - from), normal);
    const double slack = slack_m > 0 ? slack_m * length(to - from) : 0;
    return area > slack ? 1 : area < -slack ? -1 : 0;
  };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

std::optional<Vec3> interior_point(std::span<const Outline> outlines, Vec3 normal) {
  return point_inside_of(outlines, normal);
}

std::optional<Vec3> interior_point_of(std::span<const OutlineView> outlines, Vec3 normal) {
  return point_inside_of(outlines, normal);
}

double winding_part(std::span<const Outline> outlines, Vec3 eye) {
  double sum = 0;
  for (const Outline& outline : outlines)
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
      sum += solid_angle(outline[0] - eye, outline[i] - eye, outline[i + 1] - eye);
  return sum / (4 * std::numbers::pi);
}

std::optional<double> visible_level(std::span<ParallelArea> areas, double outline_m2) {
  std::ranges::sort(areas, {},
                    [](const ParallelArea& a) { return std::tuple(-a.offset_m, a.area_m2); });
  std::optional<double> level;
  double covered_m2 = 0;
  for (const ParallelArea& area : areas) {
    level = area.offset_m;
    covered_m2 += area.area_m2;
    if (covered_m2 >= outline_m2 / 2) break;
  }
  return level;
}

}  // namespace oriel
