#include "examples/generator/geometry/points_on_edges.h"

#include <algorithm>
#include <tuple>

namespace oriel::generator {
namespace {

/// A point's coordinates, that of one axis last.
struct Key {
  Um a, b, along;
  int point;
  friend bool operator<(const Key& p, const Key& q) {
    return std::tie(p.a, p.b, p.along) < std::tie(q.a, q.b, q.along);
  }
};

Key key(std::size_t axis, Point p, int point) {
  if (axis == 0) return {p.y, p.z, p.x, point};
  if (axis == 1) return {p.z, p.x, p.y, point};
  return {p.x, p.y, p.z, point};
}

}  // namespace

PointsOnEdges::PointsOnEdges(const std::vector<Point>& points) : points_(points) {
  std::vector<Key> keys(points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i)
      keys[i] = key(axis, points[i], static_cast<int>(i));
    std::sort(keys.begin(), keys.end());
    order_[axis].resize(points.size());
    place_[axis].resize(points.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
      order_[axis][i] = keys[i].point;
      place_[axis][static_cast<std::size_t>(keys[i].point)] = static_cast<int>(i);
    }
  }
}

void PointsOnEdges::append(int from, int to, std::vector<int>& found) const {
  const Point d = points_[static_cast<std::size_t>(to)] - points_[static_cast<std::size_t>(from)];
  if (d.y == 0 && d.z == 0) return append_along(0, from, to, found);
  if (d.z == 0 && d.x == 0) return append_along(1, from, to, found);
  if (d.x == 0 && d.y == 0) return append_along(2, from, to, found);
  append_slanted(from, to, found);
}

void PointsOnEdges::append_along(std::size_t axis, int from, int to,
                                 std::vector<int>& found) const {
  const int end = place_[axis][static_cast<std::size_t>(to)];
  int i = place_[axis][static_cast<std::size_t>(from)];
  const int step = i < end ? 1 : -1;
  if (i == end) return;
  for (i += step; i != end; i += step) found.push_back(order_[axis][static_cast<std::size_t>(i)]);
}

void PointsOnEdges::append_slanted(int from, int to, std::vector<int>& found) const {
  const Point p = points_[static_cast<std::size_t>(from)];
  const Point d = points_[static_cast<std::size_t>(to)] - p;
  const std::size_t first = found.size();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point r = points_[i] - p;
    if (r.z * d.x != r.x * d.z) continue;
    const Um along = dot(r, d);
    if (along <= 0 || along >= dot(d, d)) continue;
    if (cross(r, d) == Point{}) found.push_back(static_cast<int>(i));
  }
  const auto distance = [&](int i) { return dot(points_[static_cast<std::size_t>(i)] - p, d); };
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
            [&](int a, int b) { return distance(a) < distance(b); });
}

}  // namespace oriel::generator
