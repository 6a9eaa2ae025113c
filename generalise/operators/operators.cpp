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

/// As many features are cut off a copy of the solid in a step for each of its corners.
constexpr std::int64_t kCutsPerStep = 4;

#define ORIEL_ROW(name, scope, turn, ...) \
  Operator{#name, name, OperatorScope::scope, OperatorTurn::turn},
constexpr std::array kOperators{
    Operator{"omit", nullptr, OperatorScope::feature, OperatorTurn::features},
    ORIEL_OPERATORS(ORIEL_ROW)};
#undef ORIEL_ROW

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

Remainder omit(const RedrawContext& context, const Plan& plan) {
  const double half_m3 = volume_m3(context.solid) / 2;
  std::vector<FeatureId> features;
  std::vector<Refusal> refused;
  for (const Step& step : plan.steps) {
    if (step.operation != "omit") continue;
    const Feature& feature = context.feature(step.feature);
    if (feature.sense == Sense::protrusion && feature.volume_m3 > half_m3)
      refused.push_back({step.feature, "more than half of the building would go"});
    else
      features.push_back(step.feature);
  }
  if (!context.may_go_on(context.solid, 1 + std::ssize(features) / kCutsPerStep))
    return nothing_taken_off(context.solid, features);
  Remainder remainder =
      remove_features(context.solid, context.segmentation, features, context.options, context.work);
  if (context.judge != nullptr)
    remainder = remove_cells(context, std::move(remainder), kGapOnMap_m * plan.scale);
  remainder = fill_rings(context, std::move(remainder));
  remainder.refused.insert(remainder.refused.end(), refused.begin(), refused.end());
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  return remainder;
}

}  // namespace oriel
