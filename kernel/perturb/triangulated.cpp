#include "kernel/perturb/triangulated.h"

#include "kernel/base/index.h"
#include "kernel/perturb/micrometres.h"
#include "kernel/perturb/polygon_triangles.h"

namespace oriel::detail {

std::vector<Polygon> triangulated(const std::vector<Vec3>& vertices, const Polygon& polygon,
                                  Random& random) {
  if (polygon.rings.empty()) return {polygon};
  const auto place_of = [&](int vertex) { return in_micrometres(vertices[at(vertex)]); };
  const auto triangles =
      polygon_triangles(polygon.rings, area_vector(vertices, polygon.rings[0]), place_of, random);
  if (triangles.empty()) return {polygon};
  std::vector<Polygon> out;
  for (const auto& [a, b, c] : triangles) {
    Polygon& piece = out.emplace_back(polygon);
    piece.rings.assign(1, {a, b, c});
  }
  return out;
}

}  // namespace oriel::detail
