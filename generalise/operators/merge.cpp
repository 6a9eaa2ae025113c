#include "generalise/operators/merge.h"

#include <algorithm>

namespace oriel {

detail::Placed merge(const Redrawing& task) {
  Solid solid = task.solid;
  const std::vector<int>& its = task.feature().source_polygons;  // sorted
  bool is_changed = false;
  for (Facet& facet : solid.facets) {
    if (facet.polygons.empty() || !std::ranges::includes(its, facet.polygons)) continue;
    facet.polygons.clear();
    is_changed = true;
  }
  if (!is_changed) return {std::nullopt, "it has no surface of its own"};
  return {std::move(solid), {}};
}

}  // namespace oriel
