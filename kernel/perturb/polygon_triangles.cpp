#include "kernel/perturb/polygon_triangles.h"

#include "kernel/base/index.h"
#include "kernel/perturb/ear_clipping.h"

#include <cmath>
#include <map>

namespace oriel::detail {

namespace {

/// A point as it is seen against `normal` along the axis nearest to that; what is counter-clockwise
/// stays so.
FlatCorner flat_corner(const MicrometrePoint& p, Vec3 normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  FlatCorner corner{p[0], p[1]};
  double facing = normal.z;
  if (x >= y && x >= z) {
    corner = {p[1], p[2]};
    facing = normal.x;
  } else if (y >= z) {
    corner = {p[2], p[0]};
    facing = normal.y;
  }
  return facing < 0 ? FlatCorner{corner.v, corner.u} : corner;
}

}  // namespace

std::vector<std::array<int, 3>> polygon_triangles(
    const std::vector<std::vector<int>>& rings, Vec3 normal,
    const std::function<MicrometrePoint(int)>& place_of, Random& random) {
  // The rings by corners, which have numbers of their own.
  std::vector<int> vertices;
  std::vector<FlatCorner> corners;
  std::vector<std::vector<int>> numbered;
  std::map<int, int> corner_of;
  std::size_t size = 0;
  for (const std::vector<int>& ring : rings) {
    numbered.emplace_back();
    for (const int vertex : ring) {
      const auto [entry, is_new] = corner_of.emplace(vertex, static_cast<int>(corner_of.size()));
      numbered.back().push_back(entry->second);
      if (!is_new) continue;
      vertices.push_back(vertex);
      corners.push_back(flat_corner(place_of(vertex), normal));
    }
    size += ring.size();
  }
  auto triangles = clip_ears(corners, numbered, random);
  // Each hole is joined to the outer ring by a bridge that is walked twice.
  if (triangles.size() + 2 != size + 2 * (rings.size() - 1)) return {};
  for (std::array<int, 3>& triangle : triangles) {
    if (!is_counter_clockwise(corners, triangle)) return {};
    for (int& corner : triangle) corner = vertices[at(corner)];
  }
  return triangles;
}

}  // namespace oriel::detail
