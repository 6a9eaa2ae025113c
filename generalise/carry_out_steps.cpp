#include "generalise/carry_out.h"
#include "generalise/operators/operators.h"
#include "generalise/tasks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace oriel {

namespace {

class StepRunner {
 public:
  StepRunner(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
             const SegmentOptions& options, const SolidValidator& validator)
      : solid_(solid),
        segmentation_(segmentation),
        plan_(plan),
        options_(options),
        validator_(validator),
        tasks_(detail::tasks_of(plan, segmentation)) {}

  CarriedOut run() {
    while (true) {
      const std::size_t failures = failed_.size();
      CarriedOut out = attempt();
      if (failed_.size() > failures) {
        if (is_used_up(validator_.work)) return nothing_carried_out(solid_, plan_);
        continue;
      }
      for (const auto& [id, refused] : failed_) out.refused.push_back(refused);
      std::ranges::sort(out.refused, {}, &CarriedOut::Refused::feature);
      return out;
    }
  }

 private:
  [[nodiscard]] const Feature& feature(const Step& step) const {
    return segmentation_.features[step.feature.index()];
  }

  void fail(const Step& step, Code code, const std::string& reason,
            const Hindrance& hindrance = {}) {
    failed_.try_emplace(step.feature, CarriedOut::Refused{step.feature, code, reason, hindrance});
  }
  void fail(const detail::PlanTask& task, Code code, const std::string& reason,
            const Hindrance& hindrance = {}) {
    for (const Step& step : task.steps) fail(step, code, reason, hindrance);
  }
  void fail(const detail::PlanTask& task, const detail::Placed& placed) {
    const auto code_of = [](bool is_needless) { return is_needless ? Code::none : Code::G403; };
    if (placed.left.empty())
      return fail(task, code_of(placed.is_needless), placed.reason, placed.hindrance);
    for (const detail::Placed::Left& one : placed.left)
      fail(task.steps[one.member], code_of(one.is_needless), one.reason, one.hindrance);
  }

  /// Takes everything off and puts back what operators leave; what fails is not tried again.
  CarriedOut attempt() {
    Plan off{plan_.scale, {}, {}};
    for (const Step& step : plan_.steps) {
      if (failed_.contains(step.feature) || step.operation == "merge") continue;
      off.steps.push_back(step);
      off.steps.back().operation = "omit";
    }
    Remainder remainder = omit(solid_, segmentation_, off, options_, validator_);
    CarriedOut out{std::move(remainder.solid), std::move(remainder.removed), {}};
    for (const detail::PlanTask& task : tasks_) fail_if_refused(task, remainder.refused);
    for (const Refusal& refusal : remainder.refused)
      if (!failed_.contains(refusal.feature))
        out.refused.push_back({refusal.feature, refusal.code, refusal.reason});
    for (const detail::PlanTask& task : tasks_) put_back(task, out);
    return out;
  }

  void fail_if_refused(const detail::PlanTask& task, const std::vector<Refusal>& refused) {
    for (const Step& step : task.steps) {
      const auto found = std::ranges::find(refused, step.feature, &Refusal::feature);
      if (found == refused.end()) continue;
      if (!detail::takes_some(step)) return fail(task, found->code, found->reason);
      fail(step, found->code, found->reason);
    }
  }

  /// What merges was not taken off; it may have gone with what carries it.
  void merge_in(const detail::PlanTask& task, CarriedOut& out) {
    const FeatureId id = task.steps[0].feature;
    if (failed_.contains(id) || std::ranges::binary_search(out.removed, id)) return;
    detail::Placed placed = merge({out.solid, segmentation_, task.steps, plan_.scale});
    if (!placed.solid) return fail(task, Code::G403, placed.reason);
    out.solid = std::move(*placed.solid);
    out.changed.push_back(id);
    std::ranges::sort(out.changed);
  }

  void put_back(const detail::PlanTask& task, CarriedOut& out) {
    if (task.operation == "merge") return merge_in(task, out);
    const auto can_be_put_back = [&](const Step& step) {
      return !failed_.contains(step.feature) &&
             std::ranges::binary_search(out.removed, step.feature) && !went_with_another(step, out);
    };
    if (detail::takes_some(task.steps[0])) {
      detail::PlanTask some{task.operation, {}};
      std::ranges::copy_if(task.steps, std::back_inserter(some.steps), can_be_put_back);
      if (!some.steps.empty()) redraw(some, out);
    } else if (std::ranges::all_of(task.steps, can_be_put_back)) {
      redraw(task, out);
    }
  }

  /// It went with what carries it.
  [[nodiscard]] bool went_with_another(const Step& step, const CarriedOut& out) const {
    const FeatureId parent = feature(step).parent, host = feature(step).host;
    return (parent.is_valid() && std::ranges::binary_search(out.removed, parent)) ||
           (host.is_valid() && std::ranges::binary_search(out.removed, host));
  }

  void redraw(const detail::PlanTask& task, CarriedOut& out) {
    const Operator& its = operator_named(task.operation);
    detail::Placed placed = its.redraw({out.solid, segmentation_, task.steps, plan_.scale});
    if (!placed.solid) return fail(task, placed);
    if (task.operation == "flatten" && validator_ &&
        validator_.fitness_of(*placed.solid) == Fitness::unfit)
      return fail(task, Code::G403, "the moved facet would meet another part");
    out.solid = std::move(*placed.solid);
    const std::size_t kept = its.kept(task.steps);
    for (std::size_t i = 0; i < kept; ++i) {
      std::erase(out.removed, task.steps[i].feature);
      out.changed.push_back(task.steps[i].feature);
    }
    std::ranges::sort(out.changed);
  }

  const Solid& solid_;
  const Segmentation& segmentation_;
  const Plan& plan_;
  const SegmentOptions& options_;
  const SolidValidator& validator_;
  std::vector<detail::PlanTask> tasks_;
  std::map<FeatureId, CarriedOut::Refused> failed_;
};

}  // namespace

CarriedOut nothing_carried_out(const Solid& solid, const Plan& plan) {
  CarriedOut out{solid, {}, {}};
  const std::string reason = kNoWorkLeft;
  for (const Step& step : plan.steps) out.refused.push_back({step.feature, Code::E502, reason});
  std::ranges::sort(out.refused, {}, &CarriedOut::Refused::feature);
  return out;
}

CarriedOut carry_out_steps(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                           const SegmentOptions& options, const SolidValidator& validator) {
  return StepRunner(solid, segmentation, plan, options, validator).run();
}

}  // namespace oriel
