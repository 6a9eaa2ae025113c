#include "generalise/removal/polygons_around.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"

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
  for (int f = 0; f < std::ssize(solid.facets); ++f)
    facets_along_[direction_of(solid.planes[solid.facets[at(f)].plane.index()])].push_back(f);
}

std::set<int> PolygonsAround::of(const std::vector<Outline>& shape, const Plane& plane) const {
  const auto near = facets_along_.find(direction_of(plane));
  if (near == facets_along_.end()) return {};
  const auto point = interior_point(shape, plane.normal);
  if (!point) return {};
  std::set<int> polygons;
  for (const int f : near->second) {
    const Facet& facet = solid_.facets[at(f)];
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

}  // namespace oriel::detail
