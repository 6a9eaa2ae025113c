#pragma once

#include "experiments/experiment.h"
#include "experiments/measured_store.h"
#include "experiments/plan/experiment_plan.h"
#include "experiments/results/results.h"
#include "experiments/sample_set.h"

#include <functional>
#include <vector>

namespace oriel {

/// What the parts of an experiment need: its rules with their params, and how to get samples.
struct PartContext {
  const ExperimentPlan& plan;
  /// With the params of the plan.
  const RuleBase& rules;
  const ForEachShare& for_each;
  /// Samples of the set's buildings, made by another recipe.
  std::function<std::vector<Sample>(const SampleSet&, const FeatureRecipe&)> samples_by;
  /// Runs that are done, of all of the part on the set.
  std::function<void(std::size_t done, std::size_t all)> step;
};

/// What a part of the experiment comes to on a set.
MeasuredPart run_part(ExperimentPart part, const SampleSet& set, const PartContext& context);

/// The parts that a plan has, in their order.
std::vector<ExperimentPart> parts_of(const ExperimentPlan& plan);

}  // namespace oriel
