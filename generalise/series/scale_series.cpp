#include "generalise/series/scale_series.h"

#include "generalise/generalise.h"
#include "generalise/invariants/fineness.h"
#include "generalise/series/change.h"
#include "generalise/tasks.h"
#include "kernel/base/issue.h"
#include "kernel/geometry/boxes.h"
#include "model/plan.h"
#include "model/segmentation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <ranges>
#include <set>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// What one operation of a series does.
struct SeriesStep {
  Step step;  ///< what the operation is named by: the first one
  double scale = 0;
  bool is_redrawing = false;
  std::vector<Step> steps;        ///< to be carried out for it
  std::set<FeatureId> gone{};     ///< features that are gone with it
  std::vector<FeatureId> with{};  ///< other features that it is about
  Change change{};                ///< found last
};

/// Steps (indices, ascending) that no part of a change tells apart, and what they do together.
struct SeriesGroup {
  std::vector<std::size_t> steps;
  Change change;
};

/// The step of each input polygon.
std::map<int, std::size_t> polygon_owners(const std::vector<SeriesStep>& steps,
                                          const Segmentation& segmentation) {
  std::map<int, std::size_t> owners;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    std::set<FeatureId> features = steps[i].gone;
    features.insert(steps[i].step.feature);
    features.insert(steps[i].with.begin(), steps[i].with.end());
    for (const FeatureId id : features)
      for (const int polygon : segmentation.features[id.index()].source_polygons)
        owners.emplace(polygon, i);
  }
  return owners;
}

/// The step whose feature's box is nearest to the middle of a part without polygons.
std::size_t nearest(const std::vector<SeriesStep>& steps, const Change& part,
                    const Segmentation& segmentation, Vec3 origin_m) {
  const Box box = box_of(part).moved(-origin_m);
  const Vec3 middle = 0.5 * (box.min + box.max);
  const auto distance = [&](const SeriesStep& one) {
    const Box& its = segmentation.features[one.step.feature.index()].box;
    const Vec3 near{std::clamp(middle.x, its.min.x, its.max.x),
                    std::clamp(middle.y, its.min.y, its.max.y),
                    std::clamp(middle.z, its.min.z, its.max.z)};
    return length(middle - near);
  };
  return static_cast<std::size_t>(std::ranges::min_element(steps, {}, distance) - steps.begin());
}

/// Some of the ring's points are in the box and some are not.
bool passes(const MicrometreRing& ring, const Box& box, Vec3 origin_m) {
  const auto is_within = [&](const MicrometrePoint& p) {
    return contains(box, metres_of(p) - origin_m, kOnBox_m);
  };
  return std::ranges::any_of(ring, is_within) && !std::ranges::all_of(ring, is_within);
}

/// Gives the parts of a change (parts_of) to the steps whose polygons they have; steps that meet in
/// a part are one group. Every step is in one group; groups come in the order of their last steps.
/// A part without polygons goes to the step whose feature's box is nearest. `origin_m` is that of
/// the segmentation's frame.
std::vector<SeriesGroup> groups_of(const std::vector<SeriesStep>& steps, const Change& change,
                                   const Segmentation& segmentation, Vec3 origin_m) {
  const auto owners = polygon_owners(steps, segmentation);
  std::vector<std::size_t> parent(steps.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  std::vector<std::pair<std::size_t, Change>> placed;
  for (Change& part : parts_of(change)) {
    std::set<std::size_t> meeting;
    for (const auto* facets : {&part.removed, &part.added})
      for (const auto& [outer, facet] : *facets)
        for (const int polygon : facet.polygons)
          if (const auto its = owners.find(polygon); its != owners.end())
            meeting.insert(its->second);
    if (meeting.empty()) meeting.insert(nearest(steps, part, segmentation, origin_m));
    std::size_t top = 0;
    for (const std::size_t i : meeting) top = std::max(top, find(i));
    for (const std::size_t i : meeting) parent[find(i)] = top;
    placed.emplace_back(top, std::move(part));
  }
  std::map<std::size_t, SeriesGroup> by_last;
  for (std::size_t i = 0; i < steps.size(); ++i) by_last[find(i)].steps.push_back(i);
  for (auto& [number, part] : placed) unite(by_last[find(number)].change, std::move(part));
  std::vector<SeriesGroup> out;
  for (auto& [last, group] : by_last) out.push_back(std::move(group));
  return out;
}

/// The change moves the outer ring of a facet where the step's feature, or one that goes with it,
/// reaches it: a door at the foot of its wall. Without such steps the ring stays, and what others
/// on the facet do to its holes can be told apart.
bool is_on_rim(const SeriesStep& step, const Change& change, const Segmentation& segmentation,
               Vec3 origin_m) {
  std::set<FeatureId> features = step.gone;
  features.insert(step.step.feature);
  for (const auto* facets : {&change.removed, &change.added})
    for (const auto& [outer, facet] : *facets)
      for (const FeatureId id : features)
        if (passes(outer, segmentation.features[id.index()].box, origin_m)) return true;
  return false;
}

/// What drawing a state between two levels takes, for each corner, but for what comes off.
constexpr std::int64_t kStepsPerState = 128;

/// Two scales nearer than this are one: nothing on a map tells 1:2000 from 1:2020.
constexpr double kSameScale = 1.01;

bool is_same_decision(const Step& a, const Step& b) {
  return std::tie(a.feature, a.operation, a.rule) == std::tie(b.feature, b.operation, b.rule);
}

bool has_same_decisions(const Plan& a, const Plan& b) {
  return std::ranges::equal(a.steps, b.steps, is_same_decision);
}

/// They draw the same.
bool draws_the_same(const Step& a, const Step& b) {
  return std::tie(a.operation, a.rule, a.numbers, a.words) ==
         std::tie(b.operation, b.rule, b.numbers, b.words);
}

/// What takes `change` back from the state before it.
Change inverse_of(const Change& change, const LevelState& state) {
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

/// The operations that lead from one level to the next.
class LevelOperations {
 public:
  LevelOperations(const RedrawContext& context, const SeriesOrder& order, const SeriesLevel& before,
                  const SeriesLevel& after, const FiringScales& firing, const Placer& place)
      : context_(context),
        order_(order),
        before_(before),
        after_(after),
        firing_(firing),
        place_(place) {
    context_.invariants = {};  // none has to hold between levels
    context_.judge = nullptr;
    context_.settled.clear();
  }

  /// `state` is the one before and becomes the one after them.
  std::vector<SeriesOperation> run(LevelState& state) {
    const LevelState target = level_state(after_.redrawn.labelled, place_);
    const Change all = difference(state, target);
    collect_steps();
    if (steps_.empty()) {
      if (!(state == target)) throw GeometryError("a level changed without an operation");
      return {};
    }
    assign_removed();
    std::vector<Step> done = before_.steps;
    separate(std::exchange(steps_, {}), state, all, done);
    assign_installations(all);
    auto operations = finish(state);
    if (!(state == target)) throw GeometryError("the operations of a level do not lead to it");
    return operations;
  }

 private:
  [[nodiscard]] bool is_new(const Step& step) const {
    const auto old = std::ranges::find(before_.steps, step.feature, &Step::feature);
    return old == before_.steps.end() || !draws_the_same(*old, step);
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
      if (const auto found = step_of_.find(next); found != step_of_.end()) return found->second;
      open.push_back(context_.feature(next).parent);
      open.push_back(context_.feature(next).host);
    }
    return -1;
  }

  void add(SeriesStep one, const std::vector<FeatureId>& features) {
    for (const FeatureId id : features) step_of_[id] = static_cast<int>(steps_.size());
    steps_.push_back(std::move(one));
  }

  void collect_steps() {
    const Plan plan{after_.scale, after_.steps, {}};
    for (const detail::PlanTask& task : detail::tasks_of(plan, context_.segmentation)) {
      if (std::ranges::none_of(task.steps, [&](const Step& step) { return is_new(step); }))
        continue;
      SeriesStep made{task.steps[0], after_.scale, true, task.steps};
      std::vector<FeatureId> members;
      for (const Step& step : task.steps) members.push_back(step.feature);
      add_along(task.steps, members);
      for (const PushedFeature& pushed : after_.generalised.pushed)
        if (std::ranges::find(task.steps, pushed.by, &Step::feature) != task.steps.end())
          members.push_back(pushed.feature);
      add_following(members);
      made.with.assign(members.begin() + 1, members.end());
      add(std::move(made), members);
    }
    // From the outside in: what is in something that goes, goes with it.
    for (const Step& step : after_.steps)
      if (step.operation == "omit" && is_new(step) && carrier(step.feature) < 0) {
        std::vector<FeatureId> members{step.feature};
        add_along({step}, members);
        SeriesStep made{step, firing_.of(step, before_.scale, after_.scale), false, {step}};
        made.with.assign(members.begin() + 1, members.end());
        add(std::move(made), members);
      }
    join_nested();
  }

  /// Adds what goes away with the features of these steps.
  void add_along(const std::vector<Step>& steps, std::vector<FeatureId>& members) const {
    for (const Step& step : steps)
      for (const FeatureId id : step.with)
        if (was_there(id) && !step_of_.contains(id) &&
            std::ranges::binary_search(after_.generalised.removed, id) &&
            std::ranges::find(members, id) == members.end())
          members.push_back(id);
  }

  /// Adds what was drawn again with the members.
  void add_following(std::vector<FeatureId>& members) const {
    for (const FollowingFeature& one : after_.generalised.following)
      if (std::ranges::find(members, one.with) != members.end() &&
          std::ranges::find(members, one.feature) == members.end())
        members.push_back(one.feature);
  }

  /// Features may come before what carries them; those have got an operation of their own.
  void join_nested() {
    std::vector<SeriesStep> outer;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const FeatureId id = steps_[i].step.feature;
      step_of_.erase(id);
      const bool is_nested = !steps_[i].is_redrawing && carrier(id) >= 0;
      step_of_[id] = static_cast<int>(i);
      if (!is_nested) outer.push_back(steps_[i]);
    }
    steps_.clear();
    step_of_.clear();
    std::ranges::stable_sort(outer, {}, [](const SeriesStep& one) {
      return std::tuple(one.scale, one.is_redrawing, one.step.feature);
    });
    for (SeriesStep& one : outer) {
      std::vector<FeatureId> features = one.with;
      features.push_back(one.step.feature);
      add(std::move(one), features);
    }
  }

  void assign_removed() {
    for (const FeatureId id : after_.generalised.removed) {
      if (!was_there(id)) continue;
      const int number = carrier(id);
      SeriesStep& its = number < 0 ? steps_.back() : steps_[static_cast<std::size_t>(number)];
      its.gone.insert(id);
      const bool is_known =
          id == its.step.feature || std::ranges::find(its.with, id) != its.with.end();
      if (!is_known) its.with.push_back(id);
    }
    for (SeriesStep& one : steps_) std::ranges::sort(one.with);
  }

  /// Orders steps that together make `change` of `state`, each with its own, after steps_;
  /// `done` is what is carried out in the state.
  void separate(const std::vector<SeriesStep>& steps, LevelState state, const Change& change,
                std::vector<Step>& done) {
    for (SeriesGroup& group :
         groups_of(steps, change, context_.segmentation, context_.building.frame.origin_m)) {
      std::vector<SeriesStep> some;
      for (const std::size_t i : group.steps) some.push_back(steps[i]);
      if (some.size() == 1) {
        if (!apply(state, group.change)) throw GeometryError("a part of a level does not fit");
        add_separate(std::move(some[0]), std::move(group.change), done);
        continue;
      }
      for (SeriesStep& one : some) one.scale = some.back().scale;
      LevelState next = state;
      if (!apply(next, group.change)) throw GeometryError("a part of a level does not fit");
      in_turn(std::move(some), std::move(state), next, done);
      state = std::move(next);
    }
  }

  void add_separate(SeriesStep one, Change change, std::vector<Step>& done) {
    for (const Step& step : one.steps) put(step, done);
    one.change = std::move(change);
    steps_.push_back(std::move(one));
  }

  static void put(const Step& step, std::vector<Step>& steps) {
    std::erase_if(steps, [&](const Step& old) { return old.feature == step.feature; });
    steps.push_back(step);
    std::ranges::sort(steps, {}, &Step::feature);
  }

  /// Steps that together lead from `state` to `next`. One is carried out, those at the rim of a
  /// facet first; of the others it may then be known what each does. What cannot be carried out
  /// alone goes with the next one.
  void in_turn(std::vector<SeriesStep> some, LevelState state, const LevelState& next,
               std::vector<Step>& done) {
    const Change whole = difference(state, next);
    std::ranges::stable_partition(some, [&](const SeriesStep& one) {
      return is_on_rim(one, whole, context_.segmentation, context_.building.frame.origin_m);
    });
    while (some.size() > 1) {
      SeriesStep first = std::move(some.front());
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
      steps_.push_back(std::move(first));
      done = std::move(with_first);
      return separate(some, *middle, difference(*middle, next), done);
    }
    add_separate(std::move(some[0]), difference(state, next), done);
  }

  static void join(SeriesStep& one, SeriesStep& into) {
    into.gone.merge(one.gone);
    into.with.push_back(one.step.feature);
    into.with.insert(into.with.end(), one.with.begin(), one.with.end());
    std::ranges::sort(into.with);
    into.steps.insert(into.steps.end(), one.steps.begin(), one.steps.end());
    into.is_redrawing = into.is_redrawing || one.is_redrawing;
  }

  /// What the steps make, if `one` is carried out among them and leaves a closed solid that may be
  /// written.
  [[nodiscard]] std::optional<LevelState> state_of(const std::vector<Step>& steps,
                                                   const SeriesStep& one) const {
    std::vector<Issue> issues;
    if (!context_.may_go_on(context_.solid, kStepsPerState)) return std::nullopt;
    const auto level = level_of(context_, order_, Plan{after_.scale, steps, {}}, issues);
    if (!level || level->steps.size() != steps.size()) return std::nullopt;
    const auto& removed = level->generalised.removed;
    if (!std::ranges::includes(removed, one.gone)) return std::nullopt;
    if (order_.fault_of(*level->redrawn.labelled.geometry)) return std::nullopt;
    LevelState state = level_state(level->redrawn.labelled, place_);
    if (!is_closed(*labelled_building(state, context_.building.frame).geometry))
      return std::nullopt;
    return state;
  }

  /// To the operation that takes the feature of that id off, else to the last that takes a facet of
  /// the installation off.
  void assign_installations(const Change& all) {
    for (const auto& [id, attributes] : all.installations) {
      std::size_t owner = steps_.size() - 1;
      for (std::size_t i = 0; i < steps_.size(); ++i) {
        const bool takes_it = std::ranges::any_of(
            steps_[i].gone, [&](FeatureId gone) { return context_.table.id(gone) == id; });
        const bool takes_facets =
            std::ranges::any_of(steps_[i].change.removed, [&](const auto& facet) {
              return std::ranges::binary_search(facet.second.installations, id);
            });
        if (takes_it || takes_facets) owner = i;
      }
      steps_[owner].change.installations[id] = attributes;
    }
  }

  /// The counts on the building when these features are gone.
  [[nodiscard]] std::map<std::string, MemberValue> counts_of(
      const std::set<FeatureId>& removed) const {
    Redrawn counted;
    count_removed({removed.begin(), removed.end()}, context_.segmentation, context_.interpretation,
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

  std::vector<SeriesOperation> finish(LevelState& state) {
    std::vector<SeriesOperation> out;
    std::set<FeatureId> removed(before_.generalised.removed.begin(),
                                before_.generalised.removed.end());
    double scale = 0;
    for (SeriesStep& one : steps_) {
      removed.insert(one.gone.begin(), one.gone.end());
      set_counts(counts_of(removed), state, one.change);
      scale = std::max(scale, one.scale);
      SeriesOperation operation;
      operation.building = state.building;
      operation.oriel_id = context_.table.id(one.step.feature);
      operation.label = context_.interpretation.verdicts[one.step.feature.index()].label;
      operation.operation = one.step.operation;
      operation.rule = one.step.rule;
      operation.scale = scale;
      operation.aabb_m = box_of(one.change);
      for (const FeatureId id : one.with) operation.with.push_back(context_.table.id(id));
      for (const AlongFeature& along : after_.generalised.along)
        if (!along.reason.empty() && one.gone.contains(along.feature))
          operation.could_not_follow.emplace(context_.table.id(along.feature), along.reason);
      operation.inverse = inverse_of(one.change, state);
      operation.forward = std::move(one.change);
      if (!apply(state, operation.forward)) throw GeometryError("an operation does not fit");
      out.push_back(std::move(operation));
    }
    return out;
  }

  RedrawContext context_;
  const SeriesOrder& order_;
  const SeriesLevel& before_;
  const SeriesLevel& after_;
  const FiringScales& firing_;
  const Placer& place_;
  std::vector<SeriesStep> steps_;
  std::map<FeatureId, int> step_of_;  ///< by feature
};

}  // namespace

FiringScales::FiringScales(const std::vector<double>& scales, const std::vector<double>& bounds,
                           const SeriesOrder& order) {
  plans_.emplace(1, order.plan_at(1));
  for (const auto* some : {&scales, &bounds})
    for (const double scale : *some)
      if (scale > 1 && scale <= scales.back() && !plans_.contains(scale))
        plans_.emplace(scale, order.plan_at(scale));
  std::vector<double> known;
  for (const auto& [scale, plan] : plans_) known.push_back(scale);
  for (std::size_t i = 1; i < known.size(); ++i) halve(known[i - 1], known[i], order);
}

void FiringScales::halve(double low, double high, const SeriesOrder& order) {
  if (high <= low * kSameScale || has_same_decisions(plans_.at(low), plans_.at(high))) return;
  const double middle = std::round((low + high) / 2);
  if (middle <= low || middle >= high) return;
  plans_.emplace(middle, order.plan_at(middle));
  halve(low, middle, order);
  halve(middle, high, order);
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

ScaleSeries scale_series(const RedrawContext& context, const SeriesOrder& order,
                         const std::vector<SeriesLevel>& levels, const FiringScales& firing,
                         const Placer& place) {
  ScaleSeries series;
  series.finest = level_state(levels[0].redrawn.labelled, place);
  LevelState state = series.finest;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    auto operations =
        LevelOperations(context, order, levels[i - 1], levels[i], firing, place).run(state);
    std::ranges::move(operations, std::back_inserter(series.operations));
  }
  return series;
}

ScaleSeries level_series(const std::vector<SeriesLevel>& levels, const Placer& place) {
  ScaleSeries series;
  series.finest = level_state(levels[0].redrawn.labelled, place);
  LevelState state = series.finest;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    LevelState next = level_state(levels[i].redrawn.labelled, place);
    SeriesOperation& operation = series.operations.emplace_back();
    operation.building = state.building;
    operation.scale = levels[i].scale;
    operation.forward = difference(state, next);
    operation.inverse = inverse_of(operation.forward, state);
    operation.aabb_m = box_of(operation.forward);
    state = std::move(next);
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
