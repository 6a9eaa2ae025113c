#include "generalise/series/series_levels.h"

#include "generalise/tasks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

bool is_same(const Step& a, const Step& b) {
  return a.operation == b.operation && a.rule == b.rule && a.numbers == b.numbers &&
         a.words == b.words && a.group == b.group;
}

/// What went along with a feature stays gone when it gets another step.
void add_along(Step& step, const Step& before) {
  std::vector<FeatureId> along;
  std::ranges::set_union(step.with, before.with, std::back_inserter(along));
  step.with = std::move(along);
}

/// What is gone does not follow anything any more.
void keep_gone(const std::vector<FeatureId>& removed, Step& step) {
  std::erase_if(step.follows,
                [&](FeatureId id) { return std::ranges::binary_search(removed, id); });
}

/// Arguments that depend on the map are those of its scale from now on.
Step fixed(Step step, double scale) {
  if (step.operation == "omit") return step;
  if (step.operation == "enlarge" || step.operation == "symbolise")
    step.numbers.try_emplace("to", kToOnMap_m * scale);
  step.numbers.try_emplace("gap", kGapOnMap_m * scale);
  return step;
}

class Levels {
 public:
  Levels(const RedrawContext& context, const SeriesOrder& order)
      : context_(context), order_(order) {
    context_.cells = context.shared_cells();
  }

  Checked<std::vector<SeriesLevel>> run(const std::vector<double>& scales) {
    Checked<std::vector<SeriesLevel>> out;
    auto finest = level_of(context_, order_, {}, out.issues);
    if (!finest) return out;
    if (auto fault = fault_of(*finest)) {
      out.issues.push_back(std::move(*fault));
      return out;
    }
    std::vector<SeriesLevel> levels{std::move(*finest)};
    for (const double scale : scales) {
      auto level = next(levels.back(), scale, out.issues);
      if (!level) return out;
      levels.push_back(std::move(*level));
    }
    out.value = std::move(levels);
    return out;
  }

 private:
  using StepOfFeature = std::map<FeatureId, Step>;

  static StepOfFeature by_feature(const std::vector<Step>& steps) {
    StepOfFeature out;
    for (const Step& step : steps) out.emplace(step.feature, step);
    return out;
  }
  static std::vector<Step> listed(const StepOfFeature& steps) {
    std::vector<Step> out;
    for (const auto& [feature, step] : steps) out.push_back(step);
    return out;
  }

  /// What the plan asks for on top of what was done before.
  [[nodiscard]] StepOfFeature wanted(const SeriesLevel& before, double scale) const {
    StepOfFeature steps = by_feature(before.steps);
    const Plan plan = order_.plan_at(scale);
    const std::set<FeatureId> bound = bound_members(before, plan);
    for (const Step& step : plan.steps) {
      const auto found = steps.find(step.feature);
      const bool is_gone =
          found == steps.end()
              ? std::ranges::binary_search(before.generalised.removed, step.feature)
              : found->second.operation == "omit" || bound.contains(step.feature);
      if (is_gone) continue;
      Step next = fixed(step, scale);
      if (found != steps.end()) add_along(next, found->second);
      steps.insert_or_assign(step.feature, std::move(next));
    }
    return steps;
  }

  /// Members of rows of which the plan asks different things, or nothing: the row stays as it is.
  [[nodiscard]] std::set<FeatureId> bound_members(const SeriesLevel& before,
                                                  const Plan& plan) const {
    std::map<FeatureId, const Step*> asked;
    for (const Step& step : plan.steps) asked.emplace(step.feature, &step);
    std::set<FeatureId> bound;
    const Plan old{before.scale, before.steps, {}};
    for (const detail::PlanTask& task : detail::tasks_of(old, context_.segmentation)) {
      if (!detail::is_for_groups(task.steps[0]) || detail::takes_some(task.steps[0])) continue;
      const auto first = asked.find(task.steps[0].feature);
      const bool is_whole = std::ranges::all_of(task.steps, [&](const Step& step) {
        const auto its = asked.find(step.feature);
        return its != asked.end() && first != asked.end() &&
               its->second->rule == first->second->rule;
      });
      if (!is_whole)
        for (const Step& step : task.steps) bound.insert(step.feature);
    }
    return bound;
  }

  std::optional<SeriesLevel> level_after(const SeriesLevel& before, double scale,
                                         const StepOfFeature& steps, std::vector<Issue>& issues) {
    context_.invariants = order_.invariants_at(scale);
    context_.settled = before.generalised.removed;
    return level_of(context_, order_, Plan{scale, listed(steps), {}}, issues);
  }

  std::optional<SeriesLevel> next(const SeriesLevel& before, double scale,
                                  std::vector<Issue>& issues) {
    const StepOfFeature old = by_feature(before.steps);
    StepOfFeature steps = wanted(before, scale);
    if (context_.has_no_work_left() || asks_nothing_new(before, steps)) {
      SeriesLevel same = before;
      same.scale = scale;
      return same;
    }
    while (true) {
      for (auto& [feature, step] : steps) keep_gone(before.generalised.removed, step);
      std::vector<Issue> found;
      auto level = level_after(before, scale, steps, found);
      if (level && context_.has_no_work_left()) return cut_short(before, std::move(*level));
      if (!level || !restore_refused(*level, old, steps)) {
        if (level && is_setback(before, *level)) return on_top(before, steps, scale, issues);
        if (auto fault = level ? fault_of(*level) : std::nullopt)
          return given_up(before, std::move(*level), std::move(*fault), issues);
        std::ranges::move(found, std::back_inserter(issues));
        if (level && is_nothing_new(before, *level)) return unchanged(before, std::move(*level));
        return level;
      }
    }
  }

  /// The same steps were carried out.
  static bool is_nothing_new(const SeriesLevel& before, const SeriesLevel& after) {
    return std::ranges::equal(before.steps, after.steps, [](const Step& a, const Step& b) {
      return a.feature == b.feature && is_same(a, b);
    });
  }

  /// What was refused may have changed how other features go; then they stay gone as they were.
  static SeriesLevel unchanged(const SeriesLevel& before, SeriesLevel after) {
    SeriesLevel same = before;
    same.scale = after.scale;
    same.refused = std::move(after.refused);
    return same;
  }

  [[nodiscard]] std::optional<Issue> fault_of(const SeriesLevel& level) const {
    return order_.fault_of(*level.redrawn.labelled.geometry);
  }

  /// What was carried out when the work was used up, if it is more than before.
  [[nodiscard]] SeriesLevel cut_short(const SeriesLevel& before, SeriesLevel level) const {
    if (!is_setback(before, level) && !is_nothing_new(before, level) && !fault_of(level))
      return level;
    return unchanged(before, std::move(level));
  }

  static SeriesLevel given_up(const SeriesLevel& before, SeriesLevel after, Issue fault,
                              std::vector<Issue>& issues) {
    fault.severity = Severity::warning;
    fault.sentence += fmt::format("; at 1:{} it stays as at the previous scale", after.scale);
    issues.push_back(std::move(fault));
    after.refused.insert(after.refused.end(), after.steps.begin(), after.steps.end());
    return unchanged(before, std::move(after));
  }

  /// All steps were carried out, or refused, at the level before.
  static bool asks_nothing_new(const SeriesLevel& before, const StepOfFeature& steps) {
    return std::ranges::all_of(steps, [&](const auto& asked) {
      const auto is_it = [&](const Step& old) {
        return old.feature == asked.first && is_same(old, asked.second);
      };
      return std::ranges::any_of(before.steps, is_it) || std::ranges::any_of(before.refused, is_it);
    });
  }

  /// Steps that were refused give way to those that they were to take the place of. True if there
  /// were such.
  static bool restore_refused(const SeriesLevel& level, const StepOfFeature& old,
                              StepOfFeature& steps) {
    bool is_changed = false;
    for (const RefusedStep& refused : level.generalised.refused) {
      const auto before = old.find(refused.feature);
      const auto now = steps.find(refused.feature);
      if (before == old.end() || now == steps.end() || is_same(before->second, now->second))
        continue;
      now->second = before->second;
      is_changed = true;
    }
    return is_changed;
  }

  /// Something is there that was gone already, or an old step is refused.
  static bool is_setback(const SeriesLevel& before, const SeriesLevel& after) {
    const StepOfFeature now = by_feature(after.steps);
    const auto& removed = after.generalised.removed;
    const bool has_lost_a_step = std::ranges::any_of(before.steps, [&](const Step& step) {
      return !now.contains(step.feature) && !std::ranges::binary_search(removed, step.feature);
    });
    return has_lost_a_step || !std::ranges::includes(removed, before.generalised.removed);
  }

  /// The new steps on top of the old ones; tasks that would undo something, found by halving, are
  /// left.
  SeriesLevel on_top(const SeriesLevel& before, const StepOfFeature& wanted_steps, double scale,
                     std::vector<Issue>& issues) {
    SeriesLevel best = before;
    best.scale = scale;
    add_tasks(before, new_tasks(by_feature(before.steps), wanted_steps), best, issues);
    return best;
  }

  void add_tasks(const SeriesLevel& before, std::span<const std::vector<Step>> tasks,
                 SeriesLevel& best, std::vector<Issue>& issues) {
    if (tasks.empty() || context_.has_no_work_left()) return;
    StepOfFeature more = by_feature(best.steps);
    for (const std::vector<Step>& task : tasks)
      for (const Step& step : task) more.insert_or_assign(step.feature, step);
    std::vector<Issue> found;
    auto level = level_after(before, best.scale, more, found);
    if (level && !is_setback(before, *level) && !fault_of(*level)) {
      best = std::move(*level);
      std::ranges::move(found, std::back_inserter(issues));
    } else if (tasks.size() > 1) {
      add_tasks(before, tasks.first(tasks.size() / 2), best, issues);
      add_tasks(before, tasks.subspan(tasks.size() / 2), best, issues);
    } else {
      issues.push_back(context_.issue(
          Severity::warning, Code::G408, tasks[0][0].feature,
          "stays unchanged: a change that was made at a larger scale would be undone"));
    }
  }

  [[nodiscard]] std::vector<std::vector<Step>> new_tasks(const StepOfFeature& old,
                                                         const StepOfFeature& wanted_steps) const {
    const auto is_new = [&](const Step& step) {
      const auto found = old.find(step.feature);
      return found == old.end() || !is_same(found->second, step);
    };
    std::vector<std::vector<Step>> out;
    for (const auto& [feature, step] : wanted_steps)
      if (step.operation == "omit" && is_new(step)) out.push_back({step});
    const Plan plan{0, listed(wanted_steps), {}};
    for (const detail::PlanTask& task : detail::tasks_of(plan, context_.segmentation))
      if (std::ranges::any_of(task.steps, is_new)) out.push_back(task.steps);
    return out;
  }

  RedrawContext context_;  ///< of the level that is drawn
  const SeriesOrder& order_;
};

}  // namespace

std::optional<SeriesLevel> level_of(const RedrawContext& context, const SeriesOrder& order,
                                    const Plan& plan, std::vector<Issue>& issues) {
  auto made = generalise(context, plan);
  std::ranges::move(made.issues, std::back_inserter(issues));
  if (!made.value) return std::nullopt;
  SeriesLevel level;
  level.scale = plan.scale;
  const auto& refused = made.value->refused;
  for (const Step& step : plan.steps) {
    const bool is_refused =
        std::ranges::find(refused, step.feature, &RefusedStep::feature) != refused.end();
    (is_refused ? level.refused : level.steps).push_back(step);
  }
  level.generalised = *made.value;
  made.value->is_drawn_anew = true;
  level.redrawn = redraw(context, std::move(*made.value));
  order.finish(level.redrawn.labelled);
  return level;
}

Checked<std::vector<SeriesLevel>> series_levels(const RedrawContext& context,
                                                const SeriesOrder& order,
                                                const std::vector<double>& scales) {
  return Levels(context, order).run(scales);
}

}  // namespace oriel
