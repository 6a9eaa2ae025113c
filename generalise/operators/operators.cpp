#include "generalise/operators/operators.h"

#include "generalise/removal/removal.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

namespace {

constexpr double kHalf = 0.5;

/// As many features are cut off a copy of the solid in a step for each of its corners.
constexpr std::int64_t kCutsPerStep = 4;

bool is_never_for_groups(const Step& /*step*/) { return false; }
bool is_always_for_groups(const Step& /*step*/) { return true; }

std::size_t keeps_none(const std::vector<Step>& /*steps*/) { return 0; }
std::size_t keeps_all(const std::vector<Step>& steps) { return steps.size(); }
std::size_t keeps_first(const std::vector<Step>& /*steps*/) { return 1; }
std::size_t keeps_ratio(const std::vector<Step>& steps) {
  const auto ratio = steps[0].numbers.find("ratio");
  return typified_count(steps.size(), ratio == steps[0].numbers.end() ? kHalf : ratio->second);
}

constexpr std::array kOperators{
    Operator{"omit", nullptr, 0, is_never_for_groups, keeps_none},
    Operator{"merge", merge, 0, is_never_for_groups, keeps_all},
    Operator{"enlarge", enlarge, 0, is_never_for_groups, keeps_all},
    Operator{"symbolise", symbolise, 0, is_never_for_groups, keeps_all},
    Operator{"aggregate", aggregate, 0, [](const Step& step) { return !becomes_block(step); },
             keeps_first},
    Operator{"typify", typify, 0, is_always_for_groups, keeps_ratio},
    Operator{"displace", displace, 0, is_always_for_groups, keeps_all, true},
    Operator{"flatten", flatten, 1, is_never_for_groups, keeps_none},
    Operator{"collapse", collapse, 2, is_never_for_groups, keeps_all},
};

/// Nothing is taken off, as there is no work left for it.
Remainder nothing_taken_off(const Solid& solid, const std::vector<FeatureId>& features) {
  Remainder remainder{solid, {}, {}};
  const std::string reason = kNoWorkLeft;
  for (const FeatureId id : features) remainder.refused.push_back({id, reason, Code::E502});
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  return remainder;
}

}  // namespace

std::optional<detail::Host> Redrawing::host(std::size_t member) const {
  const Feature& f = feature(member);
  if (f.planes.empty()) return std::nullopt;
  const Plane& its = segmentation.planes[f.planes[0].index()];
  for (const FeatureId id : {f.host, f.parent}) {
    if (!std::ranges::binary_search(steps[member].with, id)) continue;
    for (const PlaneId split : segmentation.features[id.index()].planes) {
      const Plane& wall = segmentation.planes[split.index()];
      if (dot(wall.normal, its.normal) < 1 - detail::kOnEdge_m) continue;
      const double before_m = dot(wall.normal, f.cap_point) - wall.offset_m;
      return detail::host_at(solid, wall, f.cap_point - before_m * wall.normal);
    }
  }
  return detail::host_at(solid, its, f.cap_point);
}

const Operator& operator_named(std::string_view name) {
  const auto* found = std::ranges::find(kOperators, name, &Operator::name);
  if (found == kOperators.end())
    throw std::out_of_range("no operator " + std::string(name) + " is known");
  return *found;
}

Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options, const SolidValidator& validator) {
  const double half_m3 = volume_m3(solid) / 2;
  std::vector<FeatureId> features;
  std::vector<Refusal> refused;
  for (const Step& step : plan.steps) {
    if (step.operation != "omit") continue;
    const Feature& feature = segmentation.features[step.feature.index()];
    if (feature.sense == Sense::protrusion && feature.volume_m3 > half_m3)
      refused.push_back({step.feature, "more than half of the building would go"});
    else
      features.push_back(step.feature);
  }
  if (!may_go_on(validator.work, solid, 1 + std::ssize(features) / kCutsPerStep))
    return nothing_taken_off(solid, features);
  Remainder remainder = remove_features(solid, segmentation, features, options, validator.work);
  if (validator)
    remainder = remove_cells(solid, segmentation, std::move(remainder), validator,
                             kGapOnMap_m * plan.scale, options);
  remainder = fill_rings(segmentation, std::move(remainder), validator, options);
  remainder.refused.insert(remainder.refused.end(), refused.begin(), refused.end());
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  return remainder;
}

}  // namespace oriel
