#include "generalise/detail/carries.h"

#include <algorithm>

namespace oriel::detail {

namespace {

/// The normals of what looks down have a smaller z: cos 75°.
constexpr double kLooksDown = -0.2588;

bool looks_down(const Segmentation& segmentation, PlaneId plane) {
  return segmentation.planes[plane.index()].normal.z < kLooksDown;
}

bool is_within(const Segmentation& segmentation, FeatureId id, FeatureId outer) {
  while (id.is_valid() && id != outer) id = segmentation.features[id.index()].parent;
  return id.is_valid();
}

}  // namespace

bool carries_its_parent(const Segmentation& segmentation, FeatureId id) {
  const Feature& feature = segmentation.features[id.index()];
  if (feature.sense != Sense::protrusion || !feature.parent.is_valid() || feature.planes.empty() ||
      !looks_down(segmentation, feature.planes[0]))
    return false;
  // Facets without polygons are caps.
  const auto is_lower_side = [&](const Facet& facet) {
    return !facet.polygons.empty() && looks_down(segmentation, facet.plane);
  };
  return std::ranges::none_of(segmentation.cells, [&](const Cell& cell) {
    return cell.sign > 0 && is_within(segmentation, cell.feature, id) &&
           std::ranges::any_of(cell.facets, is_lower_side);
  });
}

}  // namespace oriel::detail
