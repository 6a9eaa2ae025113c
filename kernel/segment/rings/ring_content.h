#pragma once

#include "kernel/segment/flush/polygon_grid.h"
#include "kernel/segment/rings/rings.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// What lies in a ring, before and behind its facet.
struct RingContent {
  std::vector<int> polygons;      ///< PolygonGrid::polygons, ascending
  double parallel_m2 = 0;         ///< of those that look along the facet's normal or against it
  std::optional<double> level_m;  ///< visible_level of what is parallel, along the facet's normal
};

/// The polygons within the outline of a ring as seen along its facet's normal, from the facet on
/// outwards and inwards until there is a gap. Those that the ring is cut into are not among them.
RingContent content_of(const Ring& ring, const Solid& solid, const PolygonGrid& grid);

}  // namespace oriel::detail
