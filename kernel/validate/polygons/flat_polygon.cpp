#include "kernel/validate/polygons/flat_polygon.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// As triangulate() chooses it: the largest component of the normal, z before x before y.
std::size_t nearest_axis(Vec3 normal) {
  const double x = std::abs(normal.x);
  const double y = std::abs(normal.y);
  const double z = std::abs(normal.z);
  if (z >= x && z >= y) return 2;
  return x >= y ? 0 : 1;
}

Vec3 unit(std::size_t axis, bool is_positive) {
  const double one = is_positive ? 1 : -1;
  return {axis == 0 ? one : 0, axis == 1 ? one : 0, axis == 2 ? one : 0};
}

/// The neighbours of `point` on a ring through it: the ends of the edge that it lies in, or of the
/// two edges that it joins.
std::array<FlatPoint, 2> neighbours(const FlatPoint& point, const std::vector<FlatPoint>& ring) {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i)
    if (ring[i] == point) return {ring[(i + n - 1) % n], ring[(i + 1) % n]};
  for (std::size_t i = 0; i < n; ++i)
    if (is_on(point, ring[i], ring[(i + 1) % n])) return {ring[i], ring[(i + 1) % n]};
  return {point, point};
}

/// True if the direction to `d` lies strictly between those to `from` and `to`, counter-clockwise
/// about `p`.
bool is_between(const FlatPoint& p, const FlatPoint& from, const FlatPoint& to,
                const FlatPoint& d) {
  const int whole = turn(p, from, to);
  if (whole > 0) return turn(p, from, d) > 0 && turn(p, d, to) > 0;
  if (whole == 0) return turn(p, from, d) > 0;
  return !(turn(p, to, d) >= 0 && turn(p, d, from) >= 0);
}

}  // namespace

FlatPolygon flat_polygon(const SnappedBuilding& building, const SnappedPolygon& polygon,
                         Vec3 normal) {
  const std::size_t axis = nearest_axis(normal);
  const auto seen = [&](bool is_positive) {
    FlatPolygon flat;
    flat.axis = unit(axis, is_positive);
    for (const auto& ring : polygon.rings)
      for (auto& points = flat.rings.emplace_back(); const int vertex : ring)
        points.push_back(flattened(building.point(vertex), axis, is_positive));
    return flat;
  };
  FlatPolygon flat = seen(true);
  return orientation(flat.rings[0]) >= 0 ? flat : seen(false);
}

int orientation(const std::vector<FlatPoint>& ring) {
  exact::Int128 twice_area = 0;
  const FlatPoint& o = ring[0];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const FlatPoint& a = ring[i];
    const FlatPoint& b = ring[(i + 1) % ring.size()];
    twice_area += exact::Int128{a[0] - o[0]} * (b[1] - o[1]);
    twice_area -= exact::Int128{a[1] - o[1]} * (b[0] - o[0]);
  }
  return twice_area > 0 ? 1 : twice_area < 0 ? -1 : 0;
}

int place_in(const FlatPoint& point, const std::vector<FlatPoint>& ring) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const FlatPoint& a = ring[i];
    const FlatPoint& b = ring[(i + 1) % ring.size()];
    if (is_on(point, a, b)) return 0;
    if ((a[1] > point[1]) == (b[1] > point[1])) continue;
    const int side = turn(a, b, point);
    if ((b[1] > a[1]) == (side > 0)) is_inside = !is_inside;
  }
  return is_inside ? 1 : -1;
}

bool cross_at(const FlatPoint& point, const std::vector<FlatPoint>& p,
              const std::vector<FlatPoint>& q) {
  const auto [from, to] = neighbours(point, p);
  const auto [one, other] = neighbours(point, q);
  const auto is_left = [&](const FlatPoint& d) { return is_between(point, from, to, d); };
  const auto is_right = [&](const FlatPoint& d) { return is_between(point, to, from, d); };
  return (is_left(one) && is_right(other)) || (is_right(one) && is_left(other));
}

}  // namespace oriel::detail
