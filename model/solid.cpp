#include "model/solid.h"

#include "model/description/counting_sort.h"
#include "model/vec3.h"

#include <cstddef>

namespace oriel {

double signed_area_m2(std::span<const Vertex> vertices, const Loop& loop, Vec3 normal) {
  const auto point = [&](std::size_t i) {
    return vertices[static_cast<std::size_t>(loop[i])].point;
  };
  return dot(area_vector(loop.size(), point), normal);
}

double area_m2(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal) {
  double area = 0;
  for (const Loop& loop : facet.loops) area += signed_area_m2(vertices, loop, normal);
  return area;
}

double volume_m3(const Solid& solid) {
  double sum = 0;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    sum += plane.offset_m * area_m2(solid.vertices, facet, plane.normal);
  }
  return sum / 3;
}

double surface_m2(const Solid& solid) {
  double sum = 0;
  for (const Facet& facet : solid.facets)
    sum += area_m2(solid.vertices, facet, solid.planes[facet.plane.index()].normal);
  return sum;
}

Box box_of(const Solid& solid) {
  Box box;
  for (const Facet& facet : solid.facets)
    for (const Loop& loop : facet.loops)
      for (const int v : loop) box.grow(solid.vertices[static_cast<std::size_t>(v)].point);
  return box;
}

bool is_closed(const Solid& solid) {
  std::vector<int> from, to;
  for (const Facet& facet : solid.facets)
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        from.push_back(loop[i]);
        to.push_back(loop[i + 1 < loop.size() ? i + 1 : 0]);
      }
  const auto ends_of = [&](int i) {
    return EdgeEnds(from[static_cast<std::size_t>(i)], to[static_cast<std::size_t>(i)]);
  };
  const Numbers edges = sort_edges(from.size(), solid.vertices.size(), ends_of);
  int balance = 0;  // of the edges with the same ends: those that run up less those that run down
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && ends_of(edges[i]) != ends_of(edges[i - 1]) && balance != 0) return false;
    const auto place = static_cast<std::size_t>(edges[i]);
    balance += (from[place] < to[place]) - (from[place] > to[place]);
  }
  return !edges.empty() && balance == 0;
}

}  // namespace oriel
