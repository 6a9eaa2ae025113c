#include "tests/examples/generator/crossings.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace oriel::test {
namespace {

using generator::Body;
using generator::Extent;
using generator::Point;
using generator::Polygon;

/// An edge and its box.
struct Line {
  Point a, b;
  Extent box;
};

/// Volumes below this (m³) count as touching: features keep centimetres apart.
constexpr double kTouching = 1e-9;

double volume(Point a, Point b, Point c, Point d) {
  return dot(cross(metres(b - a), metres(c - a)), metres(d - a));
}

bool is_pierced(const Point (&t)[3], Point p, Point q) {
  const double vp = volume(t[0], t[1], t[2], p), vq = volume(t[0], t[1], t[2], q);
  if (std::abs(vp) < kTouching || std::abs(vq) < kTouching || (vp > 0) == (vq > 0)) return false;
  double sides[3];
  for (std::size_t i = 0; i < 3; ++i) sides[i] = volume(p, q, t[i], t[(i + 1) % 3]);
  for (const double side : sides)
    if (std::abs(side) < kTouching || (side > 0) != (sides[0] > 0)) return false;
  return true;
}

bool are_apart(const Extent& a, const Extent& b) {
  return a.high.x < b.low.x || b.high.x < a.low.x || a.high.y < b.low.y || b.high.y < a.low.y ||
         a.high.z < b.low.z || b.high.z < a.low.z;
}

}  // namespace

int count_crossings(const Body& body) {
  const auto is_triangle = [](const Polygon& polygon) {
    return polygon.rings.size() == 1 && polygon.rings[0].size() == 3;
  };
  if (!std::ranges::all_of(body.polygons, is_triangle))
    throw std::invalid_argument("crossings are counted of triangles only");
  const auto at = [&](int vertex) { return body.vertices[static_cast<std::size_t>(vertex)]; };
  std::vector<Line> edges;
  for (const Polygon& triangle : body.polygons)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangle.rings[0][i], b = triangle.rings[0][(i + 1) % 3];
      if (a < b) edges.push_back({at(a), at(b), generator::extent_of({at(a), at(b)})});
    }
  int crossings = 0;
  for (const Polygon& triangle : body.polygons) {
    const std::vector<int>& ring = triangle.rings[0];
    const Point corners[3] = {at(ring[0]), at(ring[1]), at(ring[2])};
    const Extent box = generator::extent_of({corners[0], corners[1], corners[2]});
    for (const Line& edge : edges)
      if (!are_apart(box, edge.box) && is_pierced(corners, edge.a, edge.b)) ++crossings;
  }
  return crossings;
}

}  // namespace oriel::test
