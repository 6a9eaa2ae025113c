#include "generalise/operators/typify.h"

#include <algorithm>
#include <cmath>

namespace oriel {

namespace {

/// What a row of recesses has in common.
struct Row {
  detail::Extents all{};
  double width = 0, height = 0, middle = 0, depth = 0;  ///< means
};

}  // namespace

std::size_t typified_count(std::size_t n, double ratio) {
  return static_cast<std::size_t>(std::max(1.0, std::round(static_cast<double>(n) * ratio)));
}

detail::Placed typify(const Redrawing& task) {
  const std::size_t n = task.steps.size();
  const std::size_t m = typified_count(n, task.number("ratio", 0.5));
  if (m >= n) return {std::nullopt, "its row has no more members than are to stay"};
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is not found any more"};
  Row row;
  row.all = extents_of(*host, task.segmentation, task.feature());
  for (std::size_t i = 0; i < n; ++i) {
    const detail::Extents one = extents_of(*host, task.segmentation, task.feature(i));
    if (task.feature(i).sense != Sense::hole || !is_box(task.feature(i), one))
      return {std::nullopt, "only recesses that are boxes can be typified"};
    const double share = 1 / static_cast<double>(n);
    row.all.u0 = std::min(row.all.u0, one.u0);
    row.all.u1 = std::max(row.all.u1, one.u1);
    row.width += share * one.width();
    row.height += share * one.height();
    row.middle += share * (one.v0 + one.v1) / 2;
    row.depth += share * one.depth();
  }
  const double grown = std::sqrt(static_cast<double>(n) / static_cast<double>(m));
  const double width = row.width * grown, height = row.height * grown;
  const double free_m = row.all.width() - width;
  if (free_m < 0) return {std::nullopt, "one of those that stay would be wider than the row"};
  detail::Placed placed{task.solid, {}};
  for (std::size_t i = 0; i < m; ++i) {
    const double part = m == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(m - 1);
    detail::Extents where = row.all;
    where.u0 += part * free_m;
    where.u1 = where.u0 + width;
    where.v0 = row.middle - height / 2;
    where.v1 = row.middle + height / 2;
    // The facet keeps its number, whatever has been sunk into it.
    placed = place_box(*placed.solid, *host, where, row.depth, Attach::sink, task.gap_m(),
                       task.feature(i).source_polygons);
    if (!placed.solid) return placed;
  }
  return placed;
}

}  // namespace oriel
