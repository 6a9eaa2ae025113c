#include "experiments/results/planned_runs.h"

#include "kernel/base/random.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string name_of_value(const SweptParam& param, double value) {
  return fmt::format("{} = {}", param.name, value_text(value, param.unit));
}

void add_one_at_a_time(const SweepPlan& sweep, std::vector<PlannedRun>& runs) {
  for (const SweptParam& param : sweep.params)
    for (const double value : param.values)
      runs.push_back({{name_of_value(param, value), param.name, value, param.unit, false},
                      {"", {{param.name, value}}, {}, {}}});
}

void add_grid(const SweepPlan& sweep, std::vector<PlannedRun>& runs) {
  std::vector<std::size_t> at(sweep.params.size(), 0);
  while (true) {
    PlannedRun run;
    for (std::size_t p = 0; p < at.size(); ++p) {
      const SweptParam& param = sweep.params[p];
      const double value = param.values[at[p]];
      run.setting.name += (p == 0 ? "" : ", ") + name_of_value(param, value);
      run.variant.params.push_back({param.name, value});
    }
    if (at.size() == 1) {
      run.setting.variable = sweep.params[0].name;
      run.setting.value = run.variant.params[0].value;
      run.setting.unit = sweep.params[0].unit;
    }
    runs.push_back(std::move(run));
    std::size_t p = at.size();
    while (p > 0 && ++at[p - 1] == sweep.params[p - 1].values.size()) at[--p] = 0;
    if (p == 0) return;
  }
}

/// With so many digits that the value can be typed: what is drawn and what is named is the same.
double rounded_draw(double value) {
  const std::string text = fmt::format("{:.6g}", value);
  double read = value;
  std::from_chars(text.data(), text.data() + text.size(), read);
  return read;
}

void add_draws(const SweepPlan& sweep, std::uint64_t seed, std::vector<PlannedRun>& runs) {
  constexpr std::uint64_t kStream = 31;  // of sweeps
  Random random(seed, kStream);
  for (int i = 1; i <= sweep.samples; ++i) {
    PlannedRun run;
    run.setting.name = fmt::format("draw {}", i);
    for (const SweptParam& param : sweep.params) {
      const double value = rounded_draw(param.low + (param.high - param.low) * random.unit());
      run.variant.params.push_back({param.name, std::min(std::max(value, param.low), param.high)});
    }
    runs.push_back(std::move(run));
  }
}

bool asks_for(const AblatePlan& plan, DroppedPart::Kind kind) {
  switch (kind) {
    case DroppedPart::Kind::rule:
      return plan.rules;
    case DroppedPart::Kind::condition:
    case DroppedPart::Kind::veto:
      return plan.conditions;
    default:
      return plan.evidence;
  }
}

/// Two conditions of a rule may read the same: runs have names of their own.
void number_repeated(std::vector<PlannedRun>& runs) {
  std::map<std::string, int> times;
  for (PlannedRun& run : runs)
    if (const int time = ++times[run.setting.name]; time > 1)
      run.setting.name += fmt::format(" ({})", time);
}

}  // namespace

std::vector<PlannedRun> runs_of(const SweepPlan& sweep, std::uint64_t seed) {
  std::vector<PlannedRun> runs;
  switch (sweep.design) {
    case SweepPlan::Design::one_at_a_time:
      add_one_at_a_time(sweep, runs);
      break;
    case SweepPlan::Design::grid:
      add_grid(sweep, runs);
      break;
    case SweepPlan::Design::random:
      add_draws(sweep, seed, runs);
      break;
  }
  for (PlannedRun& run : runs) run.variant.name = run.setting.name;
  return runs;
}

ReportTable table_of_draws(const SweepPlan& sweep, const std::vector<PlannedRun>& runs) {
  ReportTable table{"Draws of the sweep", "The values of the params in each draw.", {"run"}, {}};
  for (const SweptParam& param : sweep.params)
    table.header.push_back(param.unit.empty() ? param.name
                                              : fmt::format("{} ({})", param.name, param.unit));
  for (const PlannedRun& run : runs) {
    auto& row = table.rows.emplace_back(std::vector<std::string>{run.setting.name});
    for (const ParamValue& value : run.variant.params)
      row.push_back(fmt::format("{}", value.value));
  }
  return table;
}

std::vector<PlannedRun> runs_of(const AblatePlan& plan, const RuleBase& base) {
  std::vector<PlannedRun> runs;
  for (Variant& variant : ablations(base)) {
    if (!asks_for(plan, variant.without.front().kind)) continue;
    PlannedRun run;
    run.setting.name = variant.name;
    run.variant = std::move(variant);
    runs.push_back(std::move(run));
  }
  number_repeated(runs);
  return runs;
}

}  // namespace oriel
