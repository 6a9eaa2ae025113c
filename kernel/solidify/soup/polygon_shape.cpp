#include "kernel/solidify/soup/polygon_shape.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <numbers>

namespace oriel::detail {

namespace {

using exact::GridPoint;
using exact::Int128;

GridPoint difference(const GridPoint& p, const GridPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double length2(const GridPoint& p) {
  const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]),
               z = static_cast<double>(p[2]);
  return x * x + y * y + z * z;
}

template <class Int>
void add_cross(const GridPoint& p, const GridPoint& q, std::array<Int, 3>& sum) {
  sum[0] += Int{p[1]} * q[2] - Int{p[2]} * q[1];
  sum[1] += Int{p[2]} * q[0] - Int{p[0]} * q[2];
  sum[2] += Int{p[0]} * q[1] - Int{p[1]} * q[0];
}

template <class Int>
PolygonShape shape_in(const Soup& soup, int polygon) {
  std::array<Int, 3> sum{};  // twice the area times the normal
  const GridPoint base = soup.points[at(soup.corners_of(polygon).front())];
  bool is_outer = true;
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    // The outer ring starts at the base: its first and last edge span nothing with it.
    GridPoint before = difference(soup.points[at(is_outer ? ring[1] : ring.back())], base);
    for (const int v : ring.subspan(is_outer ? 2 : 0)) {
      const GridPoint here = difference(soup.points[at(v)], base);
      add_cross(before, here, sum);
      before = here;
    }
    is_outer = false;
  }
  PolygonShape shape;
  shape.normal = exact::direction(sum);
  if (shape.normal) shape.unit = unit(*shape.normal);
  shape.area = length({static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                       static_cast<double>(sum[2])}) /
               2;
  return shape;
}

}  // namespace

Vec3 unit(const IntegerNormal& n) {
  return normalised(
      {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])});
}

double height_of(const Soup& soup, int polygon, double area) {
  const auto corners = soup.corners_of(polygon);
  const GridPoint& base = soup.points[at(corners.front())];
  double reach2 = 0;
  for (const int v : corners)
    reach2 = std::max(reach2, length2(difference(soup.points[at(v)], base)));
  return reach2 > 0 ? area / std::sqrt(reach2) : 0;
}

double uncertainty_rad(double height, double offset) {
  return height > 2 * offset ? std::asin(2 * offset / height) : std::numbers::pi;
}

std::vector<PolygonShape> shapes_of(const Soup& soup) {
  if (soup.polygons.empty()) return {};
  GridPoint low = soup.points.front(), high = low;
  for (const GridPoint& p : soup.points)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  const GridPoint sides = difference(high, low);
  const double side = static_cast<double>(std::max({sides[0], sides[1], sides[2]}));
  std::vector<PolygonShape> shapes;
  shapes.reserve(soup.polygons.size());
  const int count = soup.polygon_count();
  for (int p = 0; p < count; ++p) {
    // Every corner adds two products at most: 64 bits do for all but the largest polygons.
    const bool is_small = 2 * side * side * static_cast<double>(soup.corners_of(p).size()) < 4e18;
    shapes.push_back(is_small ? shape_in<std::int64_t>(soup, p) : shape_in<Int128>(soup, p));
  }
  return shapes;
}

std::vector<Outline> outlines_of(const Soup& soup, int polygon) {
  std::vector<Outline> outlines;
  for (const int r : soup.rings_of(polygon)) {
    Outline& outline = outlines.emplace_back();
    for (const int v : soup.ring(r)) outline.push_back(exact::to_metres(soup.points[at(v)], 1));
  }
  return outlines;
}

OffsetSpan span_along(const Soup& soup, int polygon, const IntegerNormal& normal) {
  const auto corners = soup.corners_of(polygon);
  OffsetSpan span;
  span.low = span.high = along(normal, soup.points[at(corners.front())]);
  Int128 sum = 0;
  for (const int v : corners) {
    const std::int64_t d = along(normal, soup.points[at(v)]);
    span.low = std::min(span.low, d);
    span.high = std::max(span.high, d);
    sum += d;
  }
  span.mean =
      span.low == span.high ? span.low : static_cast<std::int64_t>(sum / std::ssize(corners));
  return span;
}

std::int64_t median_along(const Soup& soup, int polygon, const IntegerNormal& normal) {
  std::vector<std::int64_t> values;
  for (const int v : soup.corners_of(polygon)) values.push_back(along(normal, soup.points[at(v)]));
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace oriel::detail
