#include "generalise/series/level_operations.h"

#include "generalise/change.h"
#include "generalise/removal/removed.h"
#include "generalise/series/draft.h"
#include "generalise/tasks.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

bool is_same(const Step& a, const Step& b) {
  return std::tie(a.operation, a.rule, a.numbers, a.words) ==
         std::tie(b.operation, b.rule, b.numbers, b.words);
}

class LevelOperations {
 public:
  LevelOperations(const SeriesInput& input, const SeriesLevel& before, const SeriesLevel& after,
                  const FiringScales& firing, const Placer& place)
      : input_(input), before_(before), after_(after), firing_(firing), place_(place) {}

  std::vector<SeriesOperation> run(LevelState& state) {
    const LevelState target = level_state(after_.redrawn.labelled, place_);
    const Change all = difference(state, target);
    draft();
    if (drafts_.empty()) {
      if (!(state == target)) throw GeometryError("a level changed without an operation");
      return {};
    }
    share_out_gone();
    std::vector<Step> done = before_.steps;
    set_apart(std::exchange(drafts_, {}), state, all, done);
    share_out_installations(all);
    auto operations = finish(state);
    if (!(state == target)) throw GeometryError("the operations of a level do not lead to it");
    return operations;
  }

 private:
  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return input_.segmentation.features[id.index()];
  }

  [[nodiscard]] bool is_new(const Step& step) const {
    const auto old = std::ranges::find(before_.steps, step.feature, &Step::feature);
    return old == before_.steps.end() || !is_same(*old, step);
  }

  [[nodiscard]] bool was_there(FeatureId id) const {
    return !std::ranges::binary_search(before_.generalised.removed, id);
  }

  /// The operation that an ancestor of the feature, or the feature itself, is of; or -1.
  [[nodiscard]] int carrier(FeatureId id) const {
    std::vector<FeatureId> open{id};
    std::set<FeatureId> seen;
    while (!open.empty()) {
      const FeatureId next = open.back();
      open.pop_back();
      if (!next.is_valid() || !seen.insert(next).second) continue;
      if (const auto found = draft_of_.find(next); found != draft_of_.end()) return found->second;
      open.push_back(feature(next).parent);
      open.push_back(feature(next).host);
    }
    return -1;
  }

  void add(Draft draft, const std::vector<FeatureId>& features) {
    for (const FeatureId id : features) draft_of_[id] = static_cast<int>(drafts_.size());
    drafts_.push_back(std::move(draft));
  }

  void draft() {
    const Plan plan{after_.scale, after_.steps, {}};
    for (const PlanTask& task : tasks_of(plan, input_.segmentation)) {
      if (std::ranges::none_of(task.steps, [&](const Step& step) { return is_new(step); }))
        continue;
      Draft made{task.steps[0], after_.scale, true, task.steps};
      std::vector<FeatureId> members;
      for (const Step& step : task.steps) members.push_back(step.feature);
      made.with.assign(members.begin() + 1, members.end());
      add(std::move(made), members);
    }
    // From the outside in: what is in something that goes, goes with it.
    for (const Step& step : after_.steps)
      if (step.operation == "omit" && is_new(step) && carrier(step.feature) < 0)
        add({step, firing_.of(step, before_.scale, after_.scale), false, {step}}, {step.feature});
    join_nested();
  }

  /// Features may come before what carries them; those have got an operation of their own.
  void join_nested() {
    std::vector<Draft> outer;
    for (std::size_t i = 0; i < drafts_.size(); ++i) {
      const FeatureId id = drafts_[i].step.feature;
      draft_of_.erase(id);
      const bool is_nested = !drafts_[i].is_redrawing && carrier(id) >= 0;
      draft_of_[id] = static_cast<int>(i);
      if (!is_nested) outer.push_back(drafts_[i]);
    }
    drafts_.clear();
    draft_of_.clear();
    std::ranges::stable_sort(outer, {}, [](const Draft& one) {
      return std::tuple(one.scale, one.is_redrawing, one.step.feature);
    });
    for (Draft& one : outer) {
      std::vector<FeatureId> features = one.with;
      features.push_back(one.step.feature);
      add(std::move(one), features);
    }
  }

  void share_out_gone() {
    for (const FeatureId id : after_.generalised.removed) {
      if (!was_there(id)) continue;
      const int number = carrier(id);
      Draft& its = number < 0 ? drafts_.back() : drafts_[static_cast<std::size_t>(number)];
      its.gone.insert(id);
      const bool is_known =
          id == its.step.feature || std::ranges::find(its.with, id) != its.with.end();
      if (!is_known) its.with.push_back(id);
    }
    for (Draft& one : drafts_) std::ranges::sort(one.with);
  }

  /// Orders drafts that together make `change` of `state`, each with its own, behind drafts_;
  /// `done` is what is carried out in the state.
  void set_apart(const std::vector<Draft>& drafts, LevelState state, const Change& change,
                 std::vector<Step>& done) {
    for (DraftShare& share :
         shares_of(drafts, change, input_.segmentation, input_.building.frame.origin_m)) {
      std::vector<Draft> some;
      for (const std::size_t i : share.drafts) some.push_back(drafts[i]);
      if (some.size() == 1) {
        if (!apply(state, share.change)) throw GeometryError("a part of a level does not fit");
        add_set_apart(std::move(some[0]), std::move(share.change), done);
        continue;
      }
      for (Draft& one : some) one.scale = some.back().scale;
      LevelState next = state;
      if (!apply(next, share.change)) throw GeometryError("a part of a level does not fit");
      in_turn(std::move(some), std::move(state), next, done);
      state = std::move(next);
    }
  }

  void add_set_apart(Draft one, Change change, std::vector<Step>& done) {
    for (const Step& step : one.steps) put(step, done);
    one.change = std::move(change);
    drafts_.push_back(std::move(one));
  }

  static void put(const Step& step, std::vector<Step>& steps) {
    std::erase_if(steps, [&](const Step& old) { return old.feature == step.feature; });
    steps.push_back(step);
    std::ranges::sort(steps, {}, &Step::feature);
  }

  /// Drafts that together lead from `state` to `next`. One is carried out, those at the rim of a
  /// facet first; of the others it may then be told what each does. What cannot be carried out
  /// alone goes with the next one.
  void in_turn(std::vector<Draft> some, LevelState state, const LevelState& next,
               std::vector<Step>& done) {
    const Change whole = difference(state, next);
    std::ranges::stable_partition(some, [&](const Draft& one) {
      return is_on_rim(one, whole, input_.segmentation, input_.building.frame.origin_m);
    });
    while (some.size() > 1) {
      Draft first = std::move(some.front());
      some.erase(some.begin());
      std::vector<Step> with_first = done;
      for (const Step& step : first.steps) put(step, with_first);
      auto middle = state_of(with_first, first);
      if (!middle) {
        join(first, some.front());
        continue;
      }
      middle->installations = state.installations;
      middle->attributes = state.attributes;
      first.change = difference(state, *middle);
      drafts_.push_back(std::move(first));
      done = std::move(with_first);
      return set_apart(some, *middle, difference(*middle, next), done);
    }
    add_set_apart(std::move(some[0]), difference(state, next), done);
  }

  static void join(Draft& one, Draft& into) {
    into.gone.merge(one.gone);
    into.with.push_back(one.step.feature);
    into.with.insert(into.with.end(), one.with.begin(), one.with.end());
    std::ranges::sort(into.with);
    into.steps.insert(into.steps.end(), one.steps.begin(), one.steps.end());
    into.is_redrawing = into.is_redrawing || one.is_redrawing;
  }

  /// What the steps make, if `one` is carried out among them and leaves a closed solid that may be
  /// written. No invariant has to hold between levels.
  [[nodiscard]] std::optional<LevelState> state_of(const std::vector<Step>& steps,
                                                   const Draft& one) const {
    std::vector<Issue> issues;
    const auto level = level_of(input_, after_.scale, steps, {}, issues);
    if (!level || level->steps.size() != steps.size()) return std::nullopt;
    const auto& removed = level->generalised.removed;
    if (!std::ranges::includes(removed, one.gone)) return std::nullopt;
    if (input_.fault_of && input_.fault_of(*level->redrawn.labelled.geometry)) return std::nullopt;
    LevelState state = level_state(level->redrawn.labelled, place_);
    if (!is_closed(*labelled_building(state, input_.building.frame).geometry)) return std::nullopt;
    return state;
  }

  /// To the operation that takes the feature of that id off, else to the last that takes a facet of
  /// the installation off.
  void share_out_installations(const Change& all) {
    for (const auto& [id, attributes] : all.installations) {
      std::size_t owner = drafts_.size() - 1;
      for (std::size_t i = 0; i < drafts_.size(); ++i) {
        const bool takes_it = std::ranges::any_of(
            drafts_[i].gone, [&](FeatureId gone) { return input_.table.id(gone) == id; });
        const bool takes_facets =
            std::ranges::any_of(drafts_[i].change.removed, [&](const auto& facet) {
              return std::ranges::binary_search(facet.second.installations, id);
            });
        if (takes_it || takes_facets) owner = i;
      }
      drafts_[owner].change.installations[id] = attributes;
    }
  }

  /// The counts on the building when these features are gone.
  [[nodiscard]] std::map<std::string, MemberValue> counts_of(
      const std::set<FeatureId>& removed) const {
    Redrawn counted;
    count_removed({removed.begin(), removed.end()}, input_.segmentation, input_.interpretation,
                  counted);
    std::map<std::string, MemberValue> out;
    for (const auto& [name, value] : counted.labelled.attributes) out[name] = as_written(value);
    return out;
  }

  static void set_counts(const std::map<std::string, MemberValue>& counts, const LevelState& state,
                         Change& change) {
    for (const auto& [name, value] : counts) {
      const auto old = state.attributes.find(name);
      if (old == state.attributes.end() || old->second != value) change.attributes[name] = value;
    }
  }

  /// What takes `change` back from the state before it.
  static Change inverse_of(const Change& change, const LevelState& state) {
    Change inverse;
    inverse.removed = change.added;
    inverse.added = change.removed;
    for (const auto& [outer, holes] : change.holes)
      inverse.holes[outer] = {holes.added, holes.removed};
    const auto take_back = [](const auto& changed, const auto& old, auto& back) {
      for (const auto& [key, value] : changed) {
        const auto found = old.find(key);
        if (found == old.end())
          back[key] = std::nullopt;
        else
          back[key] = found->second;
      }
    };
    take_back(change.installations, state.installations, inverse.installations);
    take_back(change.attributes, state.attributes, inverse.attributes);
    return inverse;
  }

  std::vector<SeriesOperation> finish(LevelState& state) {
    std::vector<SeriesOperation> out;
    std::set<FeatureId> removed(before_.generalised.removed.begin(),
                                before_.generalised.removed.end());
    double scale = 0;
    for (Draft& one : drafts_) {
      removed.insert(one.gone.begin(), one.gone.end());
      set_counts(counts_of(removed), state, one.change);
      scale = std::max(scale, one.scale);
      SeriesOperation operation;
      operation.building = state.building;
      operation.oriel_id = input_.table.id(one.step.feature);
      operation.label = input_.interpretation.verdicts[one.step.feature.index()].label;
      operation.operation = one.step.operation;
      operation.rule = one.step.rule;
      operation.scale = scale;
      operation.aabb_m = box_of(one.change);
      for (const FeatureId id : one.with) operation.with.push_back(input_.table.id(id));
      operation.inverse = inverse_of(one.change, state);
      operation.forward = std::move(one.change);
      if (!apply(state, operation.forward)) throw GeometryError("an operation does not fit");
      out.push_back(std::move(operation));
    }
    return out;
  }

  const SeriesInput& input_;
  const SeriesLevel& before_;
  const SeriesLevel& after_;
  const FiringScales& firing_;
  const Placer& place_;
  std::vector<Draft> drafts_;
  std::map<FeatureId, int> draft_of_;  ///< by feature
};

}  // namespace

std::vector<SeriesOperation> operations_between(const SeriesInput& input, const SeriesLevel& before,
                                                const SeriesLevel& after, LevelState& state,
                                                const FiringScales& firing, const Placer& place) {
  return LevelOperations(input, before, after, firing, place).run(state);
}

}  // namespace oriel::detail
