#include "generalise/operators/facade.h"
#include "generalise/operators/operators.h"
#include "kernel/segment/remove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace oriel {

namespace {

using detail::Extents;
using detail::Host;
using detail::Placed;

/// The box around a feature and all that sits on it.
Placed block(const Redrawing& task, const Host& host) {
  const Feature& feature = task.feature();
  if (feature.sense != Sense::protrusion)
    return {std::nullopt, "only what sticks out becomes a block"};
  Extents all = extents_of(host, task.segmentation, feature);
  if (is_box(feature, all)) return {std::nullopt, "it is a block already"};
  for (const FeatureId id : with_what_sits_on(task.segmentation, {task.steps[0].feature}))
    all = united(all, extents_of(host, task.segmentation, task.segmentation.features[id.index()]));
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

/// Growth in eighths of what is wished for.
constexpr int kParts = 8;

/// A row and what it is on.
struct MemberRow {
  const Redrawing& task;
  const Host& host;
  std::vector<Extents> members;
  std::vector<double> depths;  ///< of boxes in their place

  [[nodiscard]] Clearance clearance() const { return clearance_after(host, task.gap_m(), members); }
};

/// Nothing if a member cannot be redrawn as a box.
std::optional<MemberRow> row_of(const Redrawing& task, const Host& host) {
  MemberRow row{task, host, {}, {}};
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    row.members.push_back(extents_of(host, task.segmentation, task.feature(i)));
    const auto depth_m = box_depth(host, task.feature(i), row.members.back());
    if (!depth_m) return std::nullopt;
    row.depths.push_back(*depth_m);
  }
  return row;
}

/// Draws what takes the place of members of a row, on the facet of their wall that its middle is
/// in: what stands on a wall may divide it. `spare` as attach() has it.
Placed put(const MemberRow& row, const Solid& solid, const Extents& where, double depth_m,
           Sense sense, const Feature& like, Solid* spare = nullptr) {
  const Host& one = row.host;
  const Vec3 middle = (where.u0 + where.u1) / 2 * one.u + (where.v0 + where.v1) / 2 * one.v +
                      one.plane.offset_m * one.n;
  const auto host = detail::host_at(solid, one.plane, middle);
  if (!host) return {std::nullopt, "its outline does not fit into the facet"};
  return place_like(solid, row.task.segmentation, *host, where, depth_m, sense, row.clearance(),
                    like, spare);
}

/// The same beside what is placed of the row already, which gives up its solid.
Placed put_next(const MemberRow& row, Placed& placed, const Extents& where, double depth_m,
                Sense sense, const Feature& like) {
  if (!placed.solid) return put(row, row.task.solid, where, depth_m, sense, like);
  return put(row, *placed.solid, where, depth_m, sense, like, &*placed.solid);
}

/// `count` copies of a row's mean, `grown` times as large, from its first to its last edge.
Placed typified(const MemberRow& row, const RowMeans& means, std::size_t count, double grown) {
  const double width = means.width * grown, height = means.height * grown;
  const double free_m = means.all.width() - width;
  if (free_m < 0) return {std::nullopt, "one of those that stay would be wider than the row"};
  const Sense sense = common_sense(row.task);
  Placed placed;
  for (std::size_t i = 0; i < count; ++i) {
    const double part = count == 1 ? 0.5 : static_cast<double>(i) / static_cast<double>(count - 1);
    Extents where = means.all;
    where.u0 += part * free_m;
    where.u1 = where.u0 + width;
    where.v0 = means.middle - height / 2;
    where.v1 = means.middle + height / 2;
    placed = put_next(row, placed, where, means.depth, sense, row.task.feature(i));
    if (!placed.solid) return placed;
  }
  return placed;
}

/// `count` of a row's members at their own places, as many times as wide and as high.
Placed thinned_out(const MemberRow& row, std::size_t count, double wider, double higher) {
  const std::size_t n = row.members.size();
  Placed placed;
  std::vector<std::size_t> stays;
  for (std::size_t i = 0; i < count; ++i) {
    // The ends of the row stay; of a single one there is none in the middle of two.
    const std::size_t member =
        count == 1 ? (n - 1) / 2 : (2 * i * (n - 1) + count - 1) / (2 * (count - 1));
    const Extents& now = row.members[member];
    const Extents where = grown(now, now.width() * (wider - 1), now.height() * (higher - 1));
    const Feature& feature = row.task.feature(member);
    placed = put_next(row, placed, where, row.depths[member], feature.sense, feature);
    if (!placed.solid) return placed;
    stays.push_back(member);
  }
  placed.stays = std::move(stays);
  return placed;
}

/// The members of a row that stay where something stands between their new places: at their own
/// ones, growing as far as there is room.
Placed thinned_out(const MemberRow& row, std::size_t count, double most) {
  Placed placed;
  for (int part = kParts; part > 0; --part) {
    const double grown = 1 + most * part / kParts;
    for (const auto& [wider, higher] : {std::pair{grown, grown}, {grown, 1.0}, {1.0, grown}}) {
      placed = thinned_out(row, count, wider, higher);
      if (placed.solid) return placed;
    }
  }
  return thinned_out(row, count, 1, 1);
}

/// One strip for the members from the first to before the last.
Placed strip(const MemberRow& row, const Solid& solid, std::size_t first, std::size_t last) {
  Extents all = row.members[first];
  double area_m2 = 0, volume_m3 = 0, middle = 0;
  for (std::size_t i = first; i < last; ++i) {
    const Extents& one = row.members[i];
    const double its_m2 = one.width() * one.height();
    area_m2 += its_m2;
    volume_m3 += its_m2 * row.depths[i];
    middle += its_m2 * (one.v0 + one.v1) / 2;
    all.u0 = std::min(all.u0, one.u0);
    all.u1 = std::max(all.u1, one.u1);
  }
  middle /= area_m2;
  // A strip lower than the map shows would be refused as too fine.
  const double height_m =
      std::max(area_m2 / all.width(), kGapOnMap_m * row.task.scale + detail::kNoShift_m);
  all.v0 = middle - height_m / 2;
  all.v1 = middle + height_m / 2;
  return put(row, solid, all, volume_m3 / area_m2, common_sense(row.task), row.task.feature(first));
}

/// As few strips as what stands between the members allows; those that are alone between others
/// are left as they are.
Placed strips(const MemberRow& row) {
  const std::size_t n = row.members.size();
  Placed all = strip(row, row.task.solid, 0, n);
  all.stays = {0};
  if (all.solid || n == 2) return all;
  Placed placed{row.task.solid, {}};
  std::vector<std::size_t> stays;
  std::vector<Placed::LeftMember> left;
  for (std::size_t first = 0, last = 0; first < n; first = last) {
    Placed longest;
    for (last = first + 1; last < n; ++last) {
      Placed longer = strip(row, *placed.solid, first, last + 1);
      if (!longer.solid) break;
      longest = std::move(longer);
    }
    if (!longest.solid) {
      left.push_back({first, "it is alone between other parts", true});
      continue;
    }
    placed = std::move(longest);
    stays.push_back(first);
  }
  if (stays.empty()) return all;
  if (!left.empty()) return {std::nullopt, left[0].reason, true, left};
  placed.stays = std::move(stays);
  return placed;
}

}  // namespace

bool becomes_block(const Step& step) {
  const auto into = step.words.find("into");
  return step.operation == "aggregate" && into != step.words.end() && into->second == "block";
}

/// The operator `aggregate`: the openings of one storey on one facade become a strip (paper 5.1,
/// "aggregation").
///
/// `{aggregate: {into: block}}` is for a slab with its parapet: the box around the feature and all
/// that sits on it takes their place. `{aggregate: {into: strip, gap: LENGTH}}`: the strip is of
/// the kind of most of them (recess, block or outline), as wide as all of them together from the
/// first to the last, with the area of all of them (so it is lower), about the middle of their
/// heights, and with their mean depth. It stands for the first of them along the wall; the others
/// are gone. Where something divides the row there is a strip on either side of it, and what is
/// alone between others stays as it is. Precondition: at least two, of one class, storey and wall
/// plane, each a recess in a wall, a block that is a box, or an outline. Touches: the wall's facet.
/// Inverse: omit, and the recesses that the segmentation still has.
Placed aggregate(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is no longer found"};
  if (becomes_block(task.steps[0])) return block(task, *host);
  if (task.steps.size() < 2)
    return {std::nullopt, "it is the only one of its storey and facade", true};
  const auto row = row_of(task, *host);
  if (!row)
    return {std::nullopt, "only recesses, blocks that are boxes and outlines can be aggregated"};
  return strips(*row);
}

std::size_t typified_count(std::size_t n, double ratio) {
  return static_cast<std::size_t>(std::max(1.0, std::round(static_cast<double>(n) * ratio)));
}

/// The operator `typify`: many openings of a row become fewer and larger ones (paper 5.1,
/// "typification").
///
/// `{typify: {ratio: NUMBER, gap: LENGTH}}`. Of n openings m = n · ratio stay, rounded and at least
/// one. Each has the mean width and height of the n, times √(n / m): the area and the aspect stay.
/// They stand at equal distances from the first to the last edge of the row, at the mean height of
/// its middle. The first m of the row stand for them; the others are gone. Where something stands
/// in the way, m of the row stay at their own places, the ends among them, and grow as far as there
/// is room. Precondition: at least two, as for aggregate, and m < n. Touches: the wall's facet.
/// Inverse: omit, and the recesses that the segmentation still has.
Placed typify(const Redrawing& task) {
  const std::size_t n = task.steps.size();
  const std::size_t m = typified_count(n, task.number("ratio", 0.5));
  if (m >= n) return {std::nullopt, "its row has no more members than are to stay", true};
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is no longer found"};
  const auto row = row_of(task, *host);
  if (!row)
    return {std::nullopt, "only recesses, blocks that are boxes and outlines can be typified"};
  RowMeans means;
  means.all = row->members[0];
  const double share = 1 / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Extents& one = row->members[i];
    means.all.u0 = std::min(means.all.u0, one.u0);
    means.all.u1 = std::max(means.all.u1, one.u1);
    means.width += share * one.width();
    means.height += share * one.height();
    means.middle += share * (one.v0 + one.v1) / 2;
    means.depth += share * row->depths[i];
  }
  const double most = std::sqrt(static_cast<double>(n) / static_cast<double>(m)) - 1;
  for (int part = kParts; part >= 0; --part) {
    Placed placed = typified(*row, means, m, 1 + most * part / kParts);
    if (!placed.solid) continue;
    placed.stays.emplace(m);
    std::iota(placed.stays->begin(), placed.stays->end(), std::size_t{0});
    return placed;
  }
  return thinned_out(*row, m, most);
}

}  // namespace oriel
