#include "kernel/perturb/triangulated.h"

#include "kernel/base/index.h"
#include "kernel/perturb/ear_clipping.h"
#include "kernel/perturb/micrometres.h"

#include <array>
#include <cmath>
#include <map>
#include <span>

namespace oriel::detail {

namespace {

/// A point as it is seen against `normal` along the axis nearest to that; what is counter-clockwise
/// stays so.
FlatCorner flat_corner(Vec3 p, Vec3 normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  std::array<double, 2> q{p.x, p.y};
  double facing = normal.z;
  if (x >= y && x >= z) {
    q = {p.y, p.z};
    facing = normal.x;
  } else if (y >= z) {
    q = {p.z, p.x};
    facing = normal.y;
  }
  const FlatCorner corner{in_micrometres(q[0]), in_micrometres(q[1])};
  return facing < 0 ? FlatCorner{corner.v, corner.u} : corner;
}

/// The rings of a polygon by numbers of their own.
struct SeenPolygon {
  std::vector<int> vertices;  ///< by corner
  std::vector<FlatCorner> corners;
  std::vector<std::vector<int>> rings;
  std::size_t size = 0;  ///< entries of all rings
};

SeenPolygon flat_polygon(const std::vector<Vec3>& vertices, const Polygon& polygon) {
  const Vec3 normal = area_vector(vertices, polygon.rings[0]);
  SeenPolygon out;
  std::map<int, int> corner_of;
  for (const std::vector<int>& ring : polygon.rings) {
    std::vector<int>& numbered = out.rings.emplace_back();
    for (const int vertex : ring) {
      const auto [entry, is_new] = corner_of.emplace(vertex, static_cast<int>(corner_of.size()));
      numbered.push_back(entry->second);
      if (!is_new) continue;
      out.vertices.push_back(vertex);
      out.corners.push_back(flat_corner(vertices[at(vertex)], normal));
    }
    out.size += ring.size();
  }
  return out;
}

}  // namespace

std::vector<Polygon> triangulated(const std::vector<Vec3>& vertices, const Polygon& polygon,
                                  Random& random) {
  if (polygon.rings.empty()) return {polygon};
  const SeenPolygon seen = flat_polygon(vertices, polygon);
  if (seen.size <= 3) return {polygon};
  const std::vector<std::array<int, 3>> triangles = clip_ears(seen.corners, seen.rings, random);
  // Each hole is joined to the outer ring by a bridge that is walked twice.
  const std::size_t expected = seen.size + 2 * (seen.rings.size() - 1) - 2;
  if (triangles.size() != expected) return {polygon};
  std::vector<Polygon> out;
  for (const std::array<int, 3>& triangle : triangles) {
    if (!is_counter_clockwise(seen.corners, triangle)) return {polygon};
    Polygon& piece = out.emplace_back(polygon);
    piece.rings.assign(1, {});
    for (const int corner : triangle) piece.rings[0].push_back(seen.vertices[at(corner)]);
  }
  return out;
}

}  // namespace oriel::detail
