#include "examples/generator/geometry/triangulate.h"

#include "kernel/base/index.h"
#include "kernel/perturb/polygon_triangles.h"

namespace oriel::generator {

Body triangulated(const Body& body, Random& random) {
  const auto place_of = [&](int vertex) {
    const Point p = body.vertices[at(vertex)];
    return MicrometrePoint{{p.x, p.y, p.z}};
  };
  Body result = body;
  result.polygons.clear();
  for (const Polygon& polygon : body.polygons) {
    const auto triangles =
        detail::polygon_triangles(polygon.rings, doubled_area(body, polygon), place_of, random);
    if (triangles.empty()) result.polygons.push_back(polygon);
    for (const auto& [a, b, c] : triangles) result.polygons.push_back({polygon.owner, {{a, b, c}}});
  }
  return result;
}

}  // namespace oriel::generator
