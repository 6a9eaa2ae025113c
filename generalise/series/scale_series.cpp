#include "generalise/series/scale_series.h"

#include "generalise/change.h"
#include "generalise/series/level_operations.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <ranges>
#include <tuple>

namespace oriel {

namespace {

/// Two scales nearer than this are one: nothing on a map tells 1:2000 from 1:2020.
constexpr double kSameScale = 1.01;

bool is_same_decision(const Step& a, const Step& b) {
  return std::tie(a.feature, a.operation, a.rule) == std::tie(b.feature, b.operation, b.rule);
}

bool has_same_decisions(const Plan& a, const Plan& b) {
  return std::ranges::equal(a.steps, b.steps, is_same_decision);
}

}  // namespace

FiringScales::FiringScales(const std::vector<double>& scales, const std::vector<double>& bounds,
                           const PlanAt& plan_at) {
  plans_.emplace(1, plan_at(1));
  for (const auto* some : {&scales, &bounds})
    for (const double scale : *some)
      if (scale > 1 && scale <= scales.back() && !plans_.contains(scale))
        plans_.emplace(scale, plan_at(scale));
  std::vector<double> known;
  for (const auto& [scale, plan] : plans_) known.push_back(scale);
  for (std::size_t i = 1; i < known.size(); ++i) halve(known[i - 1], known[i], plan_at);
}

void FiringScales::halve(double low, double high, const PlanAt& plan_at) {
  if (high <= low * kSameScale || has_same_decisions(plans_.at(low), plans_.at(high))) return;
  const double middle = std::round((low + high) / 2);
  if (middle <= low || middle >= high) return;
  plans_.emplace(middle, plan_at(middle));
  halve(low, middle, plan_at);
  halve(middle, high, plan_at);
}

double FiringScales::of(const Step& step, double from, double to) const {
  double first = to;
  for (auto plan = std::make_reverse_iterator(plans_.upper_bound(to)); plan != plans_.rend();
       ++plan) {
    if (plan->first <= from) break;
    const bool has_it = std::ranges::any_of(
        plan->second.steps, [&](const Step& its) { return is_same_decision(its, step); });
    if (!has_it) break;
    first = plan->first;
  }
  return first;
}

ScaleSeries scale_series(const SeriesInput& input, const std::vector<SeriesLevel>& levels,
                         const FiringScales& firing, const Placer& place) {
  ScaleSeries series;
  series.finest = level_state(levels[0].redrawn.labelled, place);
  LevelState state = series.finest;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    auto operations =
        detail::operations_between(input, levels[i - 1], levels[i], state, firing, place);
    std::ranges::move(operations, std::back_inserter(series.operations));
  }
  return series;
}

LevelState state_at(const ScaleSeries& series, double scale) {
  LevelState state = series.finest;
  if (!move_state(state, series.operations, 0, scale))
    throw GeometryError("an operation of a series does not fit the state before it");
  return state;
}

bool move_state(LevelState& state, const std::vector<SeriesOperation>& operations, double from,
                double to) {
  for (const SeriesOperation& operation : operations)
    if (operation.scale > from && operation.scale <= to && !apply(state, operation.forward))
      return false;
  for (const SeriesOperation& operation : operations | std::views::reverse)
    if (operation.scale > to && operation.scale <= from && !apply(state, operation.inverse))
      return false;
  return true;
}

}  // namespace oriel
