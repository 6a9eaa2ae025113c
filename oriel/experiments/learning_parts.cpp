#include "oriel/experiments/learning_parts.h"

#include "interpret/experiment/learn/learn_params.h"
#include "interpret/experiment/learn/search/param_fit.h"
#include "interpret/experiment/measure.h"
#include "interpret/experiment/result_rows.h"
#include "kernel/base/random.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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

}  // namespace

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

}  // namespace oriel
