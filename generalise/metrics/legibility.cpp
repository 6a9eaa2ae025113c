#include "generalise/metrics/legibility.h"

#include "generalise/invariants/fineness.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel {

namespace {

void add_length(double length_m, double least_m, std::optional<double>& smallest, int& small) {
  if (!smallest || length_m < *smallest) smallest = length_m;
  if (length_m < least_m - kRoundedOff_m) ++small;
}

}  // namespace

Legibility legibility_of(const Solid& drawn, const std::vector<WrittenOpening>& openings,
                         const FeatureTable* features, double least_m) {
  Legibility found;
  for (const Facet& facet : drawn.facets)
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        // Each edge once: its other facet has it the other way round.
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        if (from > to) continue;
        const double edge = length(drawn.vertices[at(to)].point - drawn.vertices[at(from)].point);
        found.smallest_edge_m = std::min(found.smallest_edge_m.value_or(edge), edge);
      }
  for (const NarrowGap& gap : narrow_gaps(drawn, {}, {}, kGapReach * least_m))
    add_length(gap.width_m, least_m, found.smallest_gap_m, found.narrow_gaps);
  const OpeningGaps between = opening_gaps(openings, least_m);
  if (std::isfinite(between.smallest_m)) found.smallest_opening_gap_m = between.smallest_m;
  found.narrow_opening_gaps = between.narrow;
  if (features == nullptr) return found;
  for (const double width : features->numbers(Attribute::b))
    if (!std::isnan(width))
      add_length(width, least_m, found.smallest_width_m, found.narrow_features);
  return found;
}

}  // namespace oriel
