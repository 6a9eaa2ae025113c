#include "generalise/operators/facade.h"
#include "generalise/operators/operators.h"
#include "kernel/segment/remove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace oriel {

namespace {

using detail::Extents;
using detail::Host;
using detail::Placed;

void unite(Extents& all, const Extents& one) {
  all = {std::min(all.u0, one.u0), std::max(all.u1, one.u1),     std::min(all.v0, one.v0),
         std::max(all.v1, one.v1), std::min(all.out0, one.out0), std::max(all.out1, one.out1)};
}

/// The box around a feature and all that sits on it.
Placed block(const Redrawing& task, const Host& host) {
  const Feature& feature = task.feature();
  if (feature.sense != Sense::protrusion)
    return {std::nullopt, "only what sticks out becomes a block"};
  Extents all = extents_of(host, task.segmentation, feature);
  if (is_box(feature, all)) return {std::nullopt, "it is a block already"};
  for (const FeatureId id : with_what_sits_on(task.segmentation, {task.steps[0].feature}))
    unite(all, extents_of(host, task.segmentation, task.segmentation.features[id.index()]));
  return place_box(task.solid, host, all, all.out1, Attach::raise, task.gap_m(),
                   feature.source_polygons);
}

/// What a row of recesses has in common.
struct RowMeans {
  Extents all{};
  double width = 0, height = 0, middle = 0, depth = 0;  ///< means
};

/// The kind of most of a row's members, the deeper one where they are even.
Sense common_sense(const Redrawing& task) {
  const auto count = [&](Sense sense) {
    std::ptrdiff_t found = 0;
    for (std::size_t i = 0; i < task.steps.size(); ++i) found += task.feature(i).sense == sense;
    return found;
  };
  return std::ranges::max(std::array{Sense::hole, Sense::protrusion, Sense::imprint}, {}, count);
}

/// `count` copies of a row's mean, `grown` times as large, from its first to its last edge.
Placed typified(const Redrawing& task, const Host& host, const RowMeans& row, std::size_t count,
                double grown) {
  const double width = row.width * grown, height = row.height * grown;
  const double free_m = row.all.width() - width;
  if (free_m < 0) return {std::nullopt, "one of those that stay would be wider than the row"};
  const Sense sense = common_sense(task);
  Placed placed{task.solid, {}, false};
  for (std::size_t i = 0; i < count; ++i) {
    const double part = count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(count - 1);
    Extents where = row.all;
    where.u0 += part * free_m;
    where.u1 = where.u0 + width;
    where.v0 = row.middle - height / 2;
    where.v1 = row.middle + height / 2;
    // The facet keeps its number, whatever has been sunk into it.
    placed = place_like(*placed.solid, task.segmentation, host, where, row.depth, sense,
                        task.gap_m(), task.feature(i));
    if (!placed.solid) return placed;
  }
  return placed;
}

}  // namespace

bool becomes_block(const Step& step) {
  const auto into = step.words.find("into");
  return step.operation == "aggregate" && into != step.words.end() && into->second == "block";
}

Placed aggregate(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is no longer found"};
  if (becomes_block(task.steps[0])) return block(task, *host);
  if (task.steps.size() < 2)
    return {std::nullopt, "it is the only one of its storey and facade", true};
  Extents all = extents_of(*host, task.segmentation, task.feature());
  double area_m2 = 0, volume_m3 = 0, middle = 0;
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    const Extents one = extents_of(*host, task.segmentation, task.feature(i));
    const auto depth_m = box_depth(*host, task.feature(i), one);
    if (!depth_m)
      return {std::nullopt, "only recesses, blocks that are boxes and outlines can be aggregated"};
    const double its_m2 = one.width() * one.height();
    area_m2 += its_m2;
    volume_m3 += its_m2 * *depth_m;
    middle += its_m2 * (one.v0 + one.v1) / 2;
    all.u0 = std::min(all.u0, one.u0);
    all.u1 = std::max(all.u1, one.u1);
  }
  middle /= area_m2;
  // A strip lower than the map shows would be refused as too fine.
  const double height_m =
      std::max(area_m2 / all.width(), kGapOnMap_m * task.scale + detail::kNoShift_m);
  all.v0 = middle - height_m / 2;
  all.v1 = middle + height_m / 2;
  return place_like(task.solid, task.segmentation, *host, all, volume_m3 / area_m2,
                    common_sense(task), task.gap_m(), task.feature());
}

std::size_t typified_count(std::size_t n, double ratio) {
  return static_cast<std::size_t>(std::max(1.0, std::round(static_cast<double>(n) * ratio)));
}

Placed typify(const Redrawing& task) {
  const std::size_t n = task.steps.size();
  const std::size_t m = typified_count(n, task.number("ratio", 0.5));
  if (m >= n) return {std::nullopt, "its row has no more members than are to stay", true};
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is no longer found"};
  RowMeans row;
  row.all = extents_of(*host, task.segmentation, task.feature());
  for (std::size_t i = 0; i < n; ++i) {
    const Extents one = extents_of(*host, task.segmentation, task.feature(i));
    const auto depth_m = box_depth(*host, task.feature(i), one);
    if (!depth_m)
      return {std::nullopt, "only recesses, blocks that are boxes and outlines can be typified"};
    const double share = 1 / static_cast<double>(n);
    row.all.u0 = std::min(row.all.u0, one.u0);
    row.all.u1 = std::max(row.all.u1, one.u1);
    row.width += share * one.width();
    row.height += share * one.height();
    row.middle += share * (one.v0 + one.v1) / 2;
    row.depth += share * *depth_m;
  }
  const double most = std::sqrt(static_cast<double>(n) / static_cast<double>(m)) - 1;
  constexpr int kParts = 8;
  Placed placed;
  for (int part = kParts; part >= 0 && !placed.solid; --part)
    placed = typified(task, *host, row, m, 1 + most * part / kParts);
  return placed;
}

}  // namespace oriel
