#include "generalise/operators/aggregate.h"

#include <algorithm>

namespace oriel {

detail::Placed aggregate(const Redrawing& task) {
  if (task.steps.size() < 2) return {std::nullopt, "it is the only one of its storey and facade"};
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is not found any more"};
  detail::Extents all = extents_of(*host, task.segmentation, task.feature());
  double area_m2 = 0, volume_m3 = 0, middle = 0;
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    const detail::Extents one = extents_of(*host, task.segmentation, task.feature(i));
    if (task.feature(i).sense != Sense::hole || !is_box(task.feature(i), one))
      return {std::nullopt, "only recesses that are boxes can be aggregated"};
    const double its_m2 = one.width() * one.height();
    area_m2 += its_m2;
    volume_m3 += its_m2 * one.depth();
    middle += its_m2 * (one.v0 + one.v1) / 2;
    all.u0 = std::min(all.u0, one.u0);
    all.u1 = std::max(all.u1, one.u1);
  }
  middle /= area_m2;
  const double height_m = area_m2 / all.width();
  all.v0 = middle - height_m / 2;
  all.v1 = middle + height_m / 2;
  return place_box(task.solid, *host, all, volume_m3 / area_m2, Attach::sink, task.gap_m(),
                   task.feature().source_polygons);
}

}  // namespace oriel
