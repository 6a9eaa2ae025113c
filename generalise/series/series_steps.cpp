#include "generalise/series/series_steps.h"

#include "generalise/invariants/fineness.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace oriel {

namespace {

/// The step of each input polygon.
std::map<int, std::size_t> polygon_owners(const std::vector<SeriesStep>& steps,
                                          const Segmentation& segmentation) {
  std::map<int, std::size_t> owners;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::set<FeatureId> features = steps[i].gone;
    features.insert(steps[i].step.feature);
    features.insert(steps[i].with.begin(), steps[i].with.end());
    for (const FeatureId id : features)
      for (const int polygon : segmentation.features[id.index()].source_polygons)
        owners.emplace(polygon, i);
  }
  return owners;
}

/// The step whose feature's box is nearest to the middle of a part without polygons.
std::size_t nearest(const std::vector<SeriesStep>& steps, const Change& part,
                    const Segmentation& segmentation, Vec3 origin_m) {
  const Box box = box_of(part).moved(-origin_m);
  const Vec3 middle = 0.5 * (box.min + box.max);
  const auto distance = [&](const SeriesStep& one) {
    const Box& its = segmentation.features[one.step.feature.index()].box;
    const Vec3 near{std::clamp(middle.x, its.min.x, its.max.x),
                    std::clamp(middle.y, its.min.y, its.max.y),
                    std::clamp(middle.z, its.min.z, its.max.z)};
    return length(middle - near);
  };
  return static_cast<std::size_t>(std::ranges::min_element(steps, {}, distance) - steps.begin());
}

/// Some of the ring's points are in the box and some are not.
bool passes(const MicrometreRing& ring, const Box& box, Vec3 origin_m) {
  const auto is_within = [&](const MicrometrePoint& p) {
    return contains(box, metres_of(p) - origin_m, kOnBox_m);
  };
  return std::ranges::any_of(ring, is_within) && !std::ranges::all_of(ring, is_within);
}

}  // namespace

std::vector<SeriesGroup> groups_of(const std::vector<SeriesStep>& steps, const Change& change,
                                   const Segmentation& segmentation, Vec3 origin_m) {
  const auto owners = polygon_owners(steps, segmentation);
  std::vector<std::size_t> parent(steps.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  std::vector<std::pair<std::size_t, Change>> placed;
  for (Change& part : parts_of(change)) {
    std::set<std::size_t> meeting;
    for (const auto* facets : {&part.removed, &part.added})
      for (const auto& [outer, facet] : *facets)
        for (const int polygon : facet.polygons)
          if (const auto its = owners.find(polygon); its != owners.end())
            meeting.insert(its->second);
    if (meeting.empty()) meeting.insert(nearest(steps, part, segmentation, origin_m));
    std::size_t top = 0;
    for (const std::size_t i : meeting) top = std::max(top, find(i));
    for (const std::size_t i : meeting) parent[find(i)] = top;
    placed.emplace_back(top, std::move(part));
  }
  std::map<std::size_t, SeriesGroup> by_last;
  for (std::size_t i = 0; i < steps.size(); ++i) by_last[find(i)].steps.push_back(i);
  for (auto& [number, part] : placed) unite(by_last[find(number)].change, std::move(part));
  std::vector<SeriesGroup> out;
  for (auto& [last, group] : by_last) out.push_back(std::move(group));
  return out;
}

bool is_on_rim(const SeriesStep& step, const Change& change, const Segmentation& segmentation,
               Vec3 origin_m) {
  std::set<FeatureId> features = step.gone;
  features.insert(step.step.feature);
  for (const auto* facets : {&change.removed, &change.added})
    for (const auto& [outer, facet] : *facets)
      for (const FeatureId id : features)
        if (passes(outer, segmentation.features[id.index()].box, origin_m)) return true;
  return false;
}

}  // namespace oriel
