#include "oriel/experiments/part_runner.h"

#include "interpret/experiment/count_variants.h"
#include "interpret/experiment/measure.h"
#include "interpret/experiment/planned_runs.h"
#include "interpret/experiment/result_rows.h"
#include "oriel/experiments/learning_parts.h"

#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

std::size_t samples_of_bootstrap(const ExperimentPlan& plan) {
  return static_cast<std::size_t>(plan.bootstrap);
}

void add_rows(std::vector<ResultRow> rows, MeasuredPart& part) {
  part.rows.insert(part.rows.end(), std::make_move_iterator(rows.begin()),
                   std::make_move_iterator(rows.end()));
}

/// Measures the baseline of a part and then one run after the other.
class PartAtWork {
 public:
  PartAtWork(ExperimentPart part, const SampleSet& set, const PartContext& context,
             std::size_t runs)
      : context_(context),
        runs_(runs),
        rows_(part, set.plan->name, measure(context.rules, set.samples, context.for_each),
              samples_of_bootstrap(context.plan)) {
    RunSetting own;
    own.name = kBaselineName;
    add_rows(rows_.baseline_rows(context.plan.rules.pack, own), measured_);
  }

  [[nodiscard]] std::vector<ResultRow> rows_of(const std::string& pack, const RunSetting& setting,
                                               const RunOutcomes& outcomes) const {
    return rows_.rows_of(pack, setting, outcomes);
  }
  /// Of the next run.
  void add(std::vector<ResultRow> rows) {
    add_rows(std::move(rows), measured_);
    count();
  }
  void add(const std::string& pack, const RunSetting& setting, const RunOutcomes& outcomes) {
    add(rows_of(pack, setting, outcomes));
  }

  /// The pack cannot be as a run wants it.
  void leave_out(const RunSetting& setting, const std::vector<Issue>& why) {
    left_out_[why.empty() ? "" : why.front().sentence].push_back(setting.name);
    count();
  }

  MeasuredPart take() {
    for (const auto& [why, names] : left_out_)
      measured_.left_out.push_back(
          names.size() == 1 ? fmt::format("the run '{}' is left out: {}", names.front(), why)
                            : fmt::format("{} runs, such as '{}', are left out: {}", names.size(),
                                          names.front(), why));
    return std::move(measured_);
  }
  MeasuredPart& measured() { return measured_; }

 private:
  void count() { context_.step(++done_, runs_); }

  const PartContext& context_;
  std::size_t runs_ = 0;
  std::size_t done_ = 0;
  /// Names of runs, by the reason.
  std::map<std::string, std::vector<std::string>> left_out_;
  ResultRows rows_;
  MeasuredPart measured_;
};

/// So many variants are counted at a time: what is kept of them is soon as much as the samples.
constexpr std::size_t kShareOfVariants = 64;

/// Measures runs that change nothing but the pack.
void add_variants(const std::vector<PlannedRun>& runs, const SampleSet& set,
                  const PartContext& context, PartAtWork& work) {
  std::vector<const PlannedRun*> taken;
  std::vector<Variant> variants;
  const auto measure_taken = [&] {
    if (variants.empty()) return;
    const auto counts = count_variants(context.rules, variants, set.samples, {}, context.for_each);
    if (!counts.value) throw std::logic_error("a variant that can be loaded cannot be counted");
    std::vector<std::vector<ResultRow>> rows(variants.size());
    context.for_each(variants.size(), [&](std::size_t i) {
      rows[i] = work.rows_of(context.plan.rules.pack, taken[i]->setting,
                             outcomes_of(*counts.value, i, set.samples));
    });
    for (auto& of_run : rows) work.add(std::move(of_run));
    taken.clear();
    variants.clear();
  };
  for (const PlannedRun& run : runs) {
    if (const auto pack = with_variant(context.rules, run.variant); !pack.value) {
      work.leave_out(run.setting, pack.issues);
      continue;
    }
    taken.push_back(&run);
    variants.push_back(run.variant);
    if (variants.size() == kShareOfVariants) measure_taken();
  }
  measure_taken();
}

MeasuredPart run_sweep(const SampleSet& set, const PartContext& context) {
  const auto runs = runs_of(*context.plan.sweep, context.plan.seed);
  PartAtWork work(ExperimentPart::sweep, set, context, runs.size());
  add_variants(runs, set, context, work);
  if (context.plan.sweep->design == SweepPlan::Design::random)
    work.measured().tables.push_back(table_of_draws(*context.plan.sweep, runs));
  return work.take();
}

MeasuredPart run_ablation(const SampleSet& set, const PartContext& context) {
  const auto runs = runs_of(*context.plan.ablate, context.rules);
  PartAtWork work(ExperimentPart::ablate, set, context, runs.size());
  add_variants(runs, set, context, work);
  return work.take();
}

FeatureRecipe recipe_with(const SegmentationPlan& options, const SampleSet& set,
                          const PartContext& context) {
  return {pipeline_options(context.plan.options.with(options), set.plan->ignores_semantics), {}};
}

MeasuredPart run_comparison(const SampleSet& set, const PartContext& context) {
  PartAtWork work(ExperimentPart::compare, set, context, context.plan.compare.size());
  for (const ComparedPlan& compared : context.plan.compare) {
    RunSetting setting;
    setting.name = compared.name;
    const auto rules = with_params(*compared.rules.base, compared.rules.params);
    if (!rules.value) {
      work.leave_out(setting, rules.issues);
      continue;
    }
    const auto other = compared.options.is_empty()
                           ? std::vector<Sample>()
                           : context.samples_by(set, recipe_with(compared.options, set, context));
    work.add(
        compared.rules.pack, setting,
        measure(*rules.value, compared.options.is_empty() ? set.samples : other, context.for_each));
  }
  return work.take();
}

FeatureRecipe disturbed(const DisturbancePlan& disturbance, int draw, const SampleSet& set,
                        const PartContext& context) {
  FeatureRecipe recipe = recipe_with(disturbance.options, set, context);
  Perturbation perturbation;
  perturbation.seed = context.plan.seed + static_cast<std::uint64_t>(draw);
  switch (disturbance.kind) {
    case DisturbancePlan::Kind::noise:
      perturbation.noise_m = disturbance.value;
      break;
    case DisturbancePlan::Kind::triangulation:
      perturbation.triangulates = true;
      break;
    case DisturbancePlan::Kind::rotation:
      perturbation.rotation_deg = disturbance.value;
      break;
    case DisturbancePlan::Kind::missing_faces:
      perturbation.missing_share = disturbance.value / 100;
      break;
    case DisturbancePlan::Kind::options:
      return recipe;
  }
  recipe.perturbation = perturbation;
  return recipe;
}

/// Nothing is drawn to turn a building, or to segment it by other options.
bool is_drawn(const DisturbancePlan& disturbance) {
  return disturbance.kind != DisturbancePlan::Kind::rotation &&
         disturbance.kind != DisturbancePlan::Kind::options;
}

int draws_of(const DisturbancePlan& disturbance, const StabilityPlan& plan) {
  return is_drawn(disturbance) ? plan.times : 1;
}

RunSetting setting_of(const DisturbancePlan& disturbance, int draw, int draws) {
  RunSetting setting;
  setting.name =
      disturbance.name + (draws > 1 ? fmt::format(" (draw {})", draw + 1) : std::string());
  setting.variable = disturbance.variable;
  if (!disturbance.variable.empty()) setting.value = disturbance.value;
  setting.unit = disturbance.unit;
  return setting;
}

MeasuredPart run_stability(const SampleSet& set, const PartContext& context) {
  const StabilityPlan& plan = *context.plan.stability;
  std::size_t runs = 0;
  for (const DisturbancePlan& disturbance : plan.disturbances)
    runs += static_cast<std::size_t>(draws_of(disturbance, plan));
  PartAtWork work(ExperimentPart::stability, set, context, runs);
  for (const DisturbancePlan& disturbance : plan.disturbances) {
    const int draws = draws_of(disturbance, plan);
    for (int draw = 0; draw < draws; ++draw) {
      const auto samples = context.samples_by(set, disturbed(disturbance, draw, set, context));
      work.add(context.plan.rules.pack, setting_of(disturbance, draw, draws),
               measure(context.rules, samples, context.for_each));
    }
  }
  return work.take();
}

}  // namespace

MeasuredPart run_part(ExperimentPart part, const SampleSet& set, const PartContext& context) {
  switch (part) {
    case ExperimentPart::sweep:
      return run_sweep(set, context);
    case ExperimentPart::ablate:
      return run_ablation(set, context);
    case ExperimentPart::compare:
      return run_comparison(set, context);
    case ExperimentPart::stability:
      return run_stability(set, context);
    case ExperimentPart::learning_curve:
      return run_learning_curve(set, context);
    case ExperimentPart::learn:
      break;
  }
  return run_learning(set, context);
}

std::vector<ExperimentPart> parts_of(const ExperimentPlan& plan) {
  std::vector<ExperimentPart> parts;
  const auto add_if = [&](bool is_there, ExperimentPart part) {
    if (is_there) parts.push_back(part);
  };
  add_if(plan.sweep.has_value(), ExperimentPart::sweep);
  add_if(plan.ablate.has_value(), ExperimentPart::ablate);
  add_if(!plan.compare.empty(), ExperimentPart::compare);
  add_if(plan.stability.has_value(), ExperimentPart::stability);
  add_if(plan.learning_curve.has_value(), ExperimentPart::learning_curve);
  add_if(plan.learn.has_value(), ExperimentPart::learn);
  return parts;
}

}  // namespace oriel
