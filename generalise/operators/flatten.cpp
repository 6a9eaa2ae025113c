#include "generalise/operators/flatten.h"

#include "kernel/attach/move_facet.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

/// Of more than this share of its facet a feature is what one sees of the facet.
constexpr double kMostOfFacet = 0.5;

/// An imprint on the facet that was not taken off: the facet still names its polygons.
bool carries_outline(const Redrawing& task, const detail::Host& host) {
  const std::vector<int>& its = task.solid.facets[host.facet.index()].polygons;  // sorted
  return std::ranges::any_of(task.segmentation.features, [&](const Feature& feature) {
    return feature.sense == Sense::imprint && !feature.source_polygons.empty() &&
           std::ranges::includes(its, feature.source_polygons);
  });
}

}  // namespace

detail::Placed flatten(const Redrawing& task) {
  const Feature& feature = task.feature();
  if (feature.sense == Sense::imprint) return {std::nullopt, "it has no depth"};
  const auto host = task.host();
  if (!host) return {task.solid, {}};  // what it lay on went, too
  const double facet_m2 =
      area_m2(task.solid.vertices, task.solid.facets[host->facet.index()], host->n);
  const bool is_most = feature.planes.size() == 1 && !feature.is_uncut &&
                       feature.new_area_m2 > kMostOfFacet * facet_m2;
  if (!is_most) return {task.solid, {}};
  if (carries_outline(task, *host))
    return {std::nullopt, "an outline on its wall or roof would not move along"};
  const double depth_m = extents_of(*host, task.segmentation, feature).depth();
  const double trimmed_m3 = std::min(feature.volume_m3, feature.new_area_m2 * depth_m);
  const double by_m = trimmed_m3 / facet_m2;
  MovedFacet moved =
      move_facet(task.solid, host->facet, feature.sense == Sense::protrusion ? by_m : -by_m);
  return {std::move(moved.solid), std::move(moved.reason)};
}

}  // namespace oriel
