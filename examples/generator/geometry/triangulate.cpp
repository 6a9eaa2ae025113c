#include "examples/generator/geometry/triangulate.h"

#include "kernel/base/index.h"
#include "kernel/perturb/ear_clipping.h"

#include <cmath>
#include <cstdlib>
#include <map>

namespace oriel::generator {
namespace {

/// A point's coordinates in the plane of a polygon, seen against its normal along the axis nearest
/// to that; counter-clockwise stays counter-clockwise.
detail::FlatCorner flat(Point p, Vec3 normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  detail::FlatCorner q{p.x, p.y};
  double along = normal.z;
  if (x >= y && x >= z) {
    q = {p.y, p.z};
    along = normal.x;
  } else if (y >= z) {
    q = {p.z, p.x};
    along = normal.y;
  }
  return along < 0 ? detail::FlatCorner{q.v, q.u} : q;
}

/// The rings of a polygon by numbers of their own.
struct SeenPolygon {
  std::vector<int> vertices;  ///< by corner
  std::vector<detail::FlatCorner> corners;
  std::vector<std::vector<int>> rings;
};

SeenPolygon flat(const Body& body, const Polygon& polygon) {
  const Vec3 normal = doubled_area(body, polygon);
  SeenPolygon out;
  std::map<int, int> corner_of;
  for (const std::vector<int>& ring : polygon.rings) {
    std::vector<int>& numbered = out.rings.emplace_back();
    for (const int vertex : ring) {
      const auto [entry, is_new] = corner_of.emplace(vertex, static_cast<int>(corner_of.size()));
      numbered.push_back(entry->second);
      if (!is_new) continue;
      out.vertices.push_back(vertex);
      out.corners.push_back(flat(body.vertices[at(vertex)], normal));
    }
  }
  return out;
}

}  // namespace

Body triangulated(const Body& body, Random& random) {
  Body result = body;
  result.polygons.clear();
  for (const Polygon& polygon : body.polygons) {
    const SeenPolygon seen = flat(body, polygon);
    for (const auto& [a, b, c] : detail::clip_ears(seen.corners, seen.rings, random))
      result.polygons.push_back(
          {polygon.owner, {{seen.vertices[at(a)], seen.vertices[at(b)], seen.vertices[at(c)]}}});
  }
  return result;
}

}  // namespace oriel::generator
