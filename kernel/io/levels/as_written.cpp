#include "kernel/io/levels/as_written.h"

#include "kernel/io/cityjson/cityjson_source.h"
#include "kernel/io/cityjson/write/fresh_cityjson.h"
#include "kernel/io/cityjson/write/vertex_pool.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace oriel {

namespace {

detail::Transform transform_of(const Document& document) {
  return document.source ? document.source->transform
                         : detail::fresh_cityjson(document.buildings).transform;
}

/// Vertices that rounding makes one are one.
std::vector<int> add_vertices(const Solid& solid, const detail::Transform& transform,
                              Building& written) {
  std::map<std::array<std::int64_t, 3>, int> numbers;
  std::vector<int> number_of;
  for (const Vertex& vertex : solid.vertices) {
    const auto key = detail::rounded(vertex.point, written.frame, transform);
    const auto [entry, is_new] = numbers.emplace(key, static_cast<int>(written.vertices.size()));
    if (is_new) written.vertices.push_back(detail::local_point(key, written.frame, transform));
    number_of.push_back(entry->second);
  }
  return number_of;
}

Polygon polygon_of(const Facet& facet, const std::vector<int>& number_of) {
  Polygon polygon;
  for (const Loop& loop : facet.loops) {
    auto& ring = polygon.rings.emplace_back();
    for (const int v : loop) ring.push_back(number_of[static_cast<std::size_t>(v)]);
  }
  return polygon;
}

}  // namespace

int spare_digits(const Document& document) {
  if (document.source && document.source->is_feature) return 0;
  return detail::spare_digits(transform_of(document));
}

Building as_written(const Document& document, const Building& building, const Solid& solid,
                    int digits) {
  Building written;
  written.id = building.id;
  written.lod = building.lod;
  written.frame = building.frame;
  const std::vector<int> number_of =
      add_vertices(solid, detail::finer(transform_of(document), digits), written);
  std::vector<int> shells_of_lump;
  for (const Shell& shell : solid.shells) {
    const auto lump = static_cast<std::size_t>(shell.lump);
    if (shells_of_lump.size() <= lump) shells_of_lump.resize(lump + 1, 0);
    const int number = shell.is_cavity ? ++shells_of_lump[lump] : 0;
    for (const FacetId f : shell.facets) {
      Polygon polygon = polygon_of(solid.facets[f.index()], number_of);
      polygon.source = static_cast<int>(f.index());
      polygon.body = shell.lump;
      polygon.shell = number;
      written.polygons.push_back(std::move(polygon));
    }
  }
  std::ranges::sort(written.polygons, {}, &Polygon::source);
  return written;
}

}  // namespace oriel
