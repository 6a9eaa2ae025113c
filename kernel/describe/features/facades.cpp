#include "kernel/describe/features/facades.h"

#include "kernel/base/index.h"
#include "model/tolerances.h"

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// Lies within the other one, but for the thickness of what is flat.
bool is_within(const Extent& p, const Extent& q) {
  return p.low >= q.low - kFacadeDepth_m && p.high <= q.high + kFacadeDepth_m;
}

bool do_touch(const Extent& p, const Extent& q) {
  return p.low <= q.high + kFacadeDepth_m && q.low <= p.high + kFacadeDepth_m;
}

}  // namespace

Facades::Facades(const Segmentation& segmentation, Work& work)
    : segmentation_(segmentation), work_(work) {
  for (std::size_t c = 0; c < segmentation.cells.size(); ++c) {
    if (segmentation.cells[c].sign < 0) continue;
    for (std::size_t f = 0; f < segmentation.cells[c].facets.size(); ++f)
      if (auto wall = wall_of({CellId{static_cast<int>(c)}, static_cast<int>(f)}))
        walls_.push_back(*wall);
  }
}

/// Nothing of a facet that is not steep.
std::optional<Facades::Wall> Facades::wall_of(CellFacet facet) const {
  const Cell& cell = segmentation_.cells[facet.cell.index()];
  // The facets of a void look away from it, into the building.
  const double outward = cell.sign;
  const Plane& plane = segmentation_.planes[cell.facets[at(facet.facet)].plane.index()];
  if (std::abs(plane.normal.z) > kSteepNormal) return std::nullopt;
  const auto outline = facet_outlines(segmentation_, facet).front();
  const Vec3 across = cross(Vec3{0, 0, 1}, outward * plane.normal);
  return Wall{facet, outward * plane.normal, outward * plane.offset_m,
              extent_along(outline, (1 / length(across)) * across),
              extent_along(outline, {0, 0, 1})};
}

/// The largest wall that the front is flat before, or the front itself.
CellFacet Facades::behind(CellFacet front) const {
  const auto before = wall_of(front);
  work_.add(std::ssize(walls_));
  if (!before || work_.is_used_up()) return front;
  const double parallel = std::cos(Tolerances{}.coplanar_deg * std::numbers::pi / 180);
  const Wall* largest = &*before;
  for (const Wall& wall : walls_) {
    const double gap = before->offset_m - wall.offset_m;
    if (gap <= 0 || gap > kFacadeDepth_m || dot(before->normal, wall.normal) < parallel) continue;
    if (wall.size() > largest->size() && is_within(before->across, wall.across) &&
        do_touch(before->height, wall.height))
      largest = &wall;
  }
  return largest->facet;
}

std::optional<CellFacet> Facades::of(const Feature& feature) {
  if (!feature.host_facet) return std::nullopt;
  const auto [found, is_new] =
      known_.try_emplace({feature.host_facet->cell, feature.host_facet->facet});
  if (is_new) found->second = behind(*feature.host_facet);
  return found->second;
}

std::vector<int> Facades::numbers() {
  std::map<std::tuple<CellId, int, FeatureId>, int> numbers;
  std::vector<int> facades;
  for (const Feature& feature : segmentation_.features) {
    const auto facade = of(feature);
    if (!facade) {
      facades.push_back(-1);
      continue;
    }
    const FeatureId host = feature.host;
    const bool is_in_imprint =
        host.is_valid() && segmentation_.features[host.index()].sense == Sense::imprint;
    const auto key = std::tuple(facade->cell, facade->facet, is_in_imprint ? host : FeatureId{});
    facades.push_back(numbers.emplace(key, static_cast<int>(numbers.size())).first->second);
  }
  return facades;
}

}  // namespace oriel::detail
