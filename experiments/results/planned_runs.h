#pragma once

#include "experiments/plan/experiment_plan.h"
#include "experiments/results/results.h"
#include "interpret/pack/rule_base.h"
#include "interpret/relabelling/variant.h"

#include <cstdint>
#include <vector>

namespace oriel {

/// A run on samples whose features stay: a variant of the pack.
struct PlannedRun {
  RunSetting setting;
  Variant variant;
};

/// The runs of a sweep, in the order of the plan: by param and value; of a grid the last param
/// changes fastest; random draws depend on `seed` alone.
std::vector<PlannedRun> runs_of(const SweepPlan& sweep, std::uint64_t seed);

/// What each draw of a random sweep has, as a table.
ReportTable table_of_draws(const SweepPlan& sweep, const std::vector<PlannedRun>& runs);

/// The ablations() of the pack that the plan asks for.
std::vector<PlannedRun> runs_of(const AblatePlan& plan, const RuleBase& base);

}  // namespace oriel
