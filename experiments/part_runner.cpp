#include "experiments/part_runner.h"

#include "experiments/changed_buildings.h"
#include "experiments/results/measure.h"
#include "experiments/results/planned_runs.h"
#include "experiments/results/result_rows.h"
#include "interpret/learn/count_variants.h"
#include "interpret/learn/learn_params.h"
#include "interpret/learn/search/param_fit.h"
#include "kernel/base/random.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

LearnOptions learn_options(const LearnPlan& plan, const PartContext& context) {
  LearnOptions options;
  if (plan.objective != "macro_f1") options.objective = Objective::f1_of(plan.objective);
  options.seed = context.plan.seed;
  options.bootstrap = static_cast<std::size_t>(context.plan.bootstrap);
  options.params = plan.params;
  return options;
}

/// The data were checked before: what is refused now is a fault of oriel's own.
template <class Value>
Value sure(Checked<Value> learnt) {
  if (!learnt.value)
    throw std::logic_error("what was checked cannot be learnt from: " +
                           learnt.issues.front().sentence);
  return std::move(*learnt.value);
}

/// Copies, as what is learnt from stands together.
std::vector<Sample> picked(const std::vector<Sample>& samples, const SamplePart& which) {
  std::vector<Sample> some;
  some.reserve(which.size());
  for (const std::size_t i : which) some.push_back(samples[i]);
  return some;
}

/// What the rules with these params come to on a part.
RunOutcomes measured_on(const SamplePart& part, std::span<const ParamValue> params,
                        const SampleSet& set, const PartContext& context) {
  const auto rules = with_params(context.rules, params);
  if (!rules.value) throw std::logic_error("what was learnt cannot be set");
  return measure(*rules.value, picked(set.samples, part), context.for_each);
}

void add_learnt_rows(std::vector<ResultRow> rows, MeasuredPart& measured) {
  measured.rows.insert(measured.rows.end(), std::make_move_iterator(rows.begin()),
                       std::make_move_iterator(rows.end()));
}

std::string number_text(double value) { return fmt::format("{:.3f}", value); }

ReportTable params_table(const Learnt& learnt, const SampleSet& set, const PartContext& context) {
  ReportTable table{
      "Learnt on " + set.plan->name,
      fmt::format(
          "The params that were changed for {}, learnt from {}: on all of them the "
          "objective goes from {:.3f} to {:.3f}, on held-out folds from {:.3f} to {:.3f}.{}",
          learnt.objective, counted(learnt.samples, "building"), learnt.before, learnt.after,
          learnt.held_out_before, learnt.held_out_after,
          learnt.reason.empty() ? "" : " The pack stays as it is: " + learnt.reason + "."),
      {"param", "before", "learnt", "gain", "95 %", "folds"},
      {}};
  const auto params = params_of(context.rules);
  for (const LearntParam& param : learnt.params) {
    const auto found = std::ranges::find(params, param.value.name, &PackParam::name);
    table.rows.push_back(
        {param.value.name, value_text(param.before, found->unit),
         value_text(param.value.value, found->unit), number_text(param.gain),
         fmt::format("{} .. {}", number_text(param.interval.low), number_text(param.interval.high)),
         fmt::format("{} of {}", param.folds, learnt.folds)});
  }
  return table;
}

ReportTable edges_table(const Learnt& learnt, const SampleSet& set) {
  ReportTable table{"Knife edges on " + set.plan->name,
                    "Params whose value stands so close to the flip of labels that a small change "
                    "moves the objective.",
                    {"param", "value", "flips at", "change", "objects"},
                    {}};
  for (const KnifeEdge& edge : learnt.knife_edges)
    table.rows.push_back({edge.param, value_text(edge.value, edge.unit),
                          value_text(edge.flip, edge.unit), fmt::format("{:+.3f}", edge.change),
                          fmt::format("{}", edge.objects)});
  return table;
}

/// The baseline of a part on the buildings that are held out at some time.
ResultRows rows_against_own(ExperimentPart part, const std::vector<SamplePart>& parts,
                            const SampleSet& set, const PartContext& context,
                            MeasuredPart& measured) {
  const auto held_out = picked(set.samples, samples_of_parts(parts));
  ResultRows rows(part, set.plan->name, measure(context.rules, held_out, context.for_each),
                  static_cast<std::size_t>(context.plan.bootstrap));
  RunSetting own;
  own.name = kBaselineName;
  add_learnt_rows(rows.baseline_rows(context.plan.rules.pack, own), measured);
  return rows;
}

/// So many of the buildings, drawn: another number of them draws other ones.
SamplePart drawn(SamplePart from, std::size_t count, std::uint64_t seed, std::uint64_t stream) {
  Random(seed, stream).shuffle(from);
  from.resize(count);
  std::ranges::sort(from);
  return from;
}

/// `learn` on a set: what is learnt from the buildings outside each part of its split is measured
/// on that part, all parts together; with tables of what was learnt from all of them.
MeasuredPart run_learning(const SampleSet& set, const PartContext& context) {
  MeasuredPart measured;
  const auto parts = parts_of(set.plan->split, set.buildings, context.plan.seed);
  const ResultRows rows = rows_against_own(ExperimentPart::learn, parts, set, context, measured);
  LearnOptions options = learn_options(*context.plan.learn, context);
  options.step = context.step;
  const Learnt learnt =
      sure(learn_params(context.rules, set.samples, parts, options, context.for_each));
  RunOutcomes outcomes;
  for (std::size_t p = 0; p < parts.size(); ++p)
    outcomes.merge(measured_on(parts[p], learnt.learnt_without[p], set, context));
  RunSetting setting;
  setting.name = "learnt from the other buildings";
  add_learnt_rows(rows.rows_of(context.plan.rules.pack, setting, outcomes), measured);
  measured.tables.push_back(params_table(learnt, set, context));
  if (!learnt.knife_edges.empty()) measured.tables.push_back(edges_table(learnt, set));
  return measured;
}

/// `learning_curve` on a set: for each part of its split params are learnt from so many of the
/// other buildings, which are drawn, and measured on the part.
MeasuredPart run_learning_curve(const SampleSet& set, const PartContext& context) {
  MeasuredPart measured;
  const LearnPlan& plan = *context.plan.learning_curve;
  const auto parts = parts_of(set.plan->split, set.buildings, context.plan.seed);
  const ResultRows rows =
      rows_against_own(ExperimentPart::learning_curve, parts, set, context, measured);
  const LearnOptions options = learn_options(plan, context);
  const auto times = static_cast<std::size_t>(plan.times);
  const std::size_t runs = plan.buildings.size() * times;
  std::size_t done = 0;
  for (const int buildings : plan.buildings)
    for (std::size_t time = 0; time < times; ++time) {
      const auto count = static_cast<std::size_t>(buildings);
      RunOutcomes outcomes;
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const SamplePart from = drawn(outside(parts[p], all_samples(set.samples.size())), count,
                                      context.plan.seed, (time + 1) * parts.size() + p);
        const auto learnt =
            sure(fit_params(context.rules, picked(set.samples, from), options, context.for_each));
        outcomes.merge(measured_on(parts[p], learnt, set, context));
      }
      RunSetting setting;
      setting.name = counted(count, "building") +
                     (times > 1 ? fmt::format(" (draw {})", time + 1) : std::string());
      setting.variable = "buildings";
      setting.value = buildings;
      add_learnt_rows(rows.rows_of(context.plan.rules.pack, setting, outcomes), measured);
      context.step(++done, runs);
    }
  return measured;
}

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
    if (const auto pack = with_params(context.rules, run.variant.params); !pack.value) {
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
  ChangedLabels changed(set, context);
  for (const ComparedPlan& compared : context.plan.compare) {
    RunSetting setting;
    setting.name = compared.name;
    const auto rules = with_params(*compared.rules.base, compared.rules.params);
    if (!rules.value) {
      work.leave_out(setting, rules.issues);
      continue;
    }
    const FeatureRecipe recipe = recipe_with(compared.options, set, context);
    const auto other =
        compared.options.is_empty() ? std::vector<Sample>() : context.samples_by(set, recipe);
    const auto& samples = compared.options.is_empty() ? set.samples : other;
    work.add(compared.rules.pack, setting, measure(*rules.value, samples, context.for_each));
    changed.add(compared.name, *rules.value, recipe.options, samples);
  }
  work.measured().changed.push_back(changed.draw());
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
