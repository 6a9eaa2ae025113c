#include "kernel/solidify/detail/polygon_shape.h"

#include <algorithm>
#include <numbers>

namespace oriel::detail {

namespace {

using exact::GridPoint;
using exact::Int128;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

GridPoint difference(const GridPoint& p, const GridPoint& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double length2(const GridPoint& p) {
  const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]),
               z = static_cast<double>(p[2]);
  return x * x + y * y + z * z;
}

void add_cross(const GridPoint& p, const GridPoint& q, exact::Vector128& sum) {
  sum[0] += Int128{p[1]} * q[2] - Int128{p[2]} * q[1];
  sum[1] += Int128{p[2]} * q[0] - Int128{p[0]} * q[2];
  sum[2] += Int128{p[0]} * q[1] - Int128{p[1]} * q[0];
}

double to_double(Int128 value) {
  const auto small = static_cast<std::int64_t>(value);
  return small == value ? static_cast<double>(small) : static_cast<double>(value);
}

}  // namespace

Vec3 unit(const Normal& n) {
  return normalised(
      {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])});
}

double PolygonShape::uncertainty_rad(double offset) const {
  return height > 2 * offset ? std::asin(2 * offset / height) : std::numbers::pi;
}

PolygonShape shape_of(const Soup& soup, int polygon) {
  exact::Vector128 sum{};  // twice the area times the normal
  double reach2 = 0;
  const GridPoint base = soup.points[at(soup.corners_of(polygon).front())];
  bool is_outer = true;
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    // The outer ring starts at the base: its first and last edge span nothing with it.
    GridPoint before = difference(soup.points[at(is_outer ? ring[1] : ring.back())], base);
    if (is_outer) reach2 = length2(before);
    for (const int v : ring.subspan(is_outer ? 2 : 0)) {
      const GridPoint here = difference(soup.points[at(v)], base);
      add_cross(before, here, sum);
      reach2 = std::max(reach2, length2(here));
      before = here;
    }
    is_outer = false;
  }
  PolygonShape shape;
  shape.normal = exact::direction(sum);
  if (shape.normal) shape.unit = unit(*shape.normal);
  shape.area = length({to_double(sum[0]), to_double(sum[1]), to_double(sum[2])}) / 2;
  shape.height = reach2 > 0 ? shape.area / std::sqrt(reach2) : 0;
  return shape;
}

Span span_along(const Soup& soup, int polygon, const Normal& normal) {
  const auto corners = soup.corners_of(polygon);
  Span span;
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

}  // namespace oriel::detail
