#include "generalise/removal/carries.h"

#include "generalise/operators/slopes.h"

#include <algorithm>

namespace oriel::detail {

bool is_within(const Segmentation& segmentation, FeatureId id, FeatureId outer) {
  while (id.is_valid() && id != outer) id = segmentation.features[id.index()].parent;
  return id.is_valid();
}

bool carries_its_parent(const Segmentation& segmentation, FeatureId id) {
  const Feature& feature = segmentation.features[id.index()];
  const auto is_below = [&](PlaneId plane) {
    return looks_down(segmentation.planes[plane.index()].normal);
  };
  if (feature.sense != Sense::protrusion || !feature.parent.is_valid() || feature.planes.empty() ||
      !is_below(feature.planes[0]))
    return false;
  // Facets without polygons are caps.
  const auto is_lower_side = [&](const Facet& facet) {
    return !facet.polygons.empty() && is_below(facet.plane);
  };
  return std::ranges::none_of(segmentation.cells, [&](const Cell& cell) {
    return cell.sign > 0 && is_within(segmentation, cell.feature, id) &&
           std::ranges::any_of(cell.facets, is_lower_side);
  });
}

}  // namespace oriel::detail
