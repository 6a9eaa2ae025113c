#include "generalise/operators/enlarge.h"

#include <algorithm>

namespace oriel {

detail::Placed enlarge(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is not found any more"};
  const Feature& feature = task.feature();
  const detail::Extents now = extents_of(*host, task.segmentation, feature);
  const bool is_block = feature.sense == Sense::protrusion;
  if ((feature.sense != Sense::hole && !is_block) || !is_box(feature, now))
    return {std::nullopt, "only recesses and blocks that are boxes can be enlarged"};
  const double to_m = task.to_m();
  const double more_u = std::max(0.0, to_m - now.width());
  const double more_v = std::max(0.0, to_m - now.height());
  if (more_u == 0 && more_v == 0) return {std::nullopt, "it is large enough"};
  const bool is_on_sill = task.word("anchor", "centre") == "sill";
  constexpr int kParts = 8;
  detail::Placed placed;
  for (int part = kParts; part > 0; --part) {
    const double u = more_u * part / kParts, v = more_v * part / kParts;
    detail::Extents then = now;
    then.u0 -= u / 2;
    then.u1 += u / 2;
    then.v0 -= is_on_sill ? 0 : v / 2;
    then.v1 += is_on_sill ? v : v / 2;
    placed =
        place_box(task.solid, *host, then, now.depth(), is_block ? Attach::raise : Attach::sink,
                  task.gap_m(), feature.source_polygons);
    if (placed.solid) break;
  }
  return placed;
}

}  // namespace oriel
