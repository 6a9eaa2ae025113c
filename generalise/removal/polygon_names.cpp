#include "generalise/removal/polygon_names.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// The same for parallel planes.
std::array<std::int64_t, 3> direction_of(const Plane& plane) {
  return std::max(plane.coefficients, exact::opposite(plane).coefficients);
}

}  // namespace

PolygonsAround::PolygonsAround(const Solid& solid, double weld_m) : solid_(solid), weld_m_(weld_m) {
  for (const FacetId f : ids_below<FacetId>(solid.facets.size()))
    facets_along_[direction_of(solid.planes[solid.facets[f.index()].plane.index()])].push_back(f);
}

std::set<int> PolygonsAround::of(const std::vector<Outline>& shape, const Plane& plane) const {
  const auto near = facets_along_.find(direction_of(plane));
  if (near == facets_along_.end()) return {};
  const auto point = interior_point(shape, plane.normal);
  if (!point) return {};
  std::set<int> polygons;
  for (const FacetId f : near->second) {
    const Facet& facet = solid_.facets[f.index()];
    const Plane& its = solid_.planes[facet.plane.index()];
    const bool is_same = its.coefficients == plane.coefficients ? its.offset == plane.offset
                                                                : its.offset == -plane.offset;
    const bool is_in_plane = is_same || std::abs(dot(its.normal, *point) - its.offset_m) <= weld_m_;
    if (!is_in_plane) continue;
    if (contains(outlines_of(solid_.vertices, facet.loops), its.normal, *point))
      polygons.insert(facet.polygons.begin(), facet.polygons.end());
  }
  return polygons;
}

const std::vector<int>& FaceNames::of(FaceId id) {
  const auto [entry, is_new] = known_.try_emplace(id);
  if (!is_new) return entry->second;
  const Face& face = complex_.face(id);
  const auto found = around_.of(outlines_of(complex_.vertices(), face.loops),
                                segmentation_.planes[face.plane.index()]);
  return entry->second = {found.begin(), found.end()};
}

}  // namespace oriel::detail
