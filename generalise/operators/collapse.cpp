#include "generalise/operators/collapse.h"

#include "kernel/segment/flush/draw_imprints.h"

#include <algorithm>
#include <iterator>

namespace oriel {

detail::Placed collapse(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall or roof is not found any more"};
  const Feature& feature = task.feature();
  if (feature.sense == Sense::imprint) return {std::nullopt, "it has no depth"};
  const detail::Extents e = extents_of(*host, task.segmentation, feature);
  // An imprint is what the segmentation calls one: a facet's polygons with an outline.
  Segmentation drawn;
  drawn.planes = {host->plane};
  Feature imprint = feature;
  imprint.sense = Sense::imprint;
  imprint.planes = {PlaneId{0}};
  for (const auto& [u, v] : {std::pair{e.u0, e.v0}, {e.u1, e.v0}, {e.u1, e.v1}, {e.u0, e.v1}}) {
    imprint.outline.push_back(static_cast<int>(drawn.vertices.size()));
    drawn.vertices.push_back({u * host->u + v * host->v + host->plane.offset_m * host->n, false});
  }
  drawn.features = {imprint};
  Solid solid = task.solid;
  auto& polygons = solid.facets[host->facet.index()].polygons;
  polygons.insert(polygons.end(), imprint.source_polygons.begin(), imprint.source_polygons.end());
  std::ranges::sort(polygons);
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  const std::size_t before = solid.facets.size();
  solid = draw_imprints(std::move(solid), drawn, {FeatureId{0}});
  if (solid.facets.size() == before || !is_closed(solid))
    return {std::nullopt, "its outline does not fit into the facet"};
  return {std::move(solid), {}};
}

}  // namespace oriel
