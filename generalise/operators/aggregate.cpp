#include "generalise/operators/aggregate.h"

#include "kernel/segment/remove.h"

#include <algorithm>

namespace oriel {

namespace {

void unite(detail::Extents& all, const detail::Extents& one) {
  all = {std::min(all.u0, one.u0), std::max(all.u1, one.u1),     std::min(all.v0, one.v0),
         std::max(all.v1, one.v1), std::min(all.out0, one.out0), std::max(all.out1, one.out1)};
}

/// The box around a feature and all that sits on it.
detail::Placed block(const Redrawing& task, const detail::Host& host) {
  const Feature& feature = task.feature();
  if (feature.sense != Sense::protrusion)
    return {std::nullopt, "only what sticks out becomes a block"};
  detail::Extents all = extents_of(host, task.segmentation, feature);
  if (is_box(feature, all)) return {std::nullopt, "it is a block already"};
  for (const FeatureId id : with_what_sits_on(task.segmentation, {task.steps[0].feature}))
    unite(all, extents_of(host, task.segmentation, task.segmentation.features[id.index()]));
  return place_box(task.solid, host, all, all.out1, Attach::raise, task.gap_m(),
                   feature.source_polygons);
}

}  // namespace

bool becomes_block(const Step& step) {
  const auto into = step.words.find("into");
  return step.operation == "aggregate" && into != step.words.end() && into->second == "block";
}

detail::Placed aggregate(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is not found any more"};
  if (becomes_block(task.steps[0])) return block(task, *host);
  if (task.steps.size() < 2) return {std::nullopt, "it is the only one of its storey and facade"};
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
