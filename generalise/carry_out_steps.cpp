#include "generalise/carry_out.h"
#include "generalise/operators/facade.h"
#include "generalise/operators/follow.h"
#include "generalise/operators/operators.h"
#include "generalise/operators/push.h"
#include "generalise/tasks.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace oriel {

namespace {

constexpr int kEighths = 8;
/// A gap is no smaller: attach takes no less.
constexpr double kLeastGap_m = 0.001;

/// The greatest of some values from 0 to `most` with which something acts, if it does with 0; with
/// `most` it does not.
template <class Acts>
std::optional<int> greatest(int most, const Acts& acts) {
  if (most < 1 || !acts(0)) return std::nullopt;
  int good = 0, bad = most;
  while (bad - good > 1) {
    const int middle = good + (bad - good) / 2;
    (acts(middle) ? good : bad) = middle;
  }
  return good;
}

/// Finds what would let an operator act that was refused on these features: with a smaller `gap`,
/// of symbolise a smaller `to`, of typify a smaller `ratio`. The greatest of eighths of what was
/// asked for is told with which it does act; found by halving, so four trials at most for each.
/// Also the features that are nearer than the gap.
class HindranceFinder {
 public:
  HindranceFinder(const Operator& its, const Redrawing& task) : its_(its), task_(task) {}

  Hindrance run() {
    const auto kind = std::ranges::find(operator_table(), its_.name, &OperatorKind::name);
    const double gap_m = task_.gap_m();
    if (kind->takes("gap")) add_length("gap", std::min(kLeastGap_m, gap_m), gap_m);
    if (its_.name == "symbolise") add_length("to", task_.to_m() / kEighths, task_.to_m());
    if (kind->takes("ratio")) add_ratio();
    if (its_.name != "symbolise") add_beside();
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool acts_with(const char* name, double value) const {
    Redrawing other{task_.solid, task_.segmentation, task_.steps, task_.scale};
    for (Step& step : other.steps) step.numbers[name] = value;
    return its_.redraw(other).solid.has_value();
  }

  void add_length(const char* name, double least_m, double asked_m) {
    const auto value = [&](int eighth) {
      return least_m + (asked_m - least_m) * eighth / kEighths;
    };
    const auto found =
        greatest(kEighths, [&](int eighth) { return acts_with(name, value(eighth)); });
    if (found) out_.needs.push_back({name, asked_m - value(*found), value(*found)});
  }

  void add_ratio() {
    const auto n = static_cast<double>(task_.steps.size());
    const double asked = task_.number("ratio", 0.5);
    const auto stay = static_cast<int>(typified_count(task_.steps.size(), asked));
    const auto found =
        greatest(stay - 1, [&](int fewer) { return acts_with("ratio", (1 + fewer) / n); });
    if (found) out_.needs.push_back({"ratio", asked - (1 + *found) / n, (1 + *found) / n});
  }

  /// What is nearer than the gap to where the features were.
  void add_beside() {
    const auto host = task_.host();
    if (!host) return;
    detail::Extents all = extents_of(*host, task_.segmentation, task_.feature());
    for (std::size_t i = 1; i < task_.steps.size(); ++i)
      all = united(all, extents_of(*host, task_.segmentation, task_.feature(i)));
    out_.beside =
        detail::FacadeRoom(task_.solid, task_.segmentation, *host).beside(all, task_.gap_m());
  }

  const Operator& its_;
  const Redrawing& task_;
  Hindrance out_;
};

/// As many features are drawn in a step for each corner of the solid: what is near is sought for
/// each of them.
constexpr std::int64_t kDrawnPerStep = 4;

/// As many changes are tried to find what hinders an operator.
constexpr std::size_t kTriesForNeeds = 8;

class StepRunner {
 public:
  StepRunner(const RedrawContext& context, const Plan& plan,
             std::map<FeatureId, Hindrance>& hindrances)
      : context_(context),
        segmentation_(context.segmentation),
        plan_(plan),
        hindrances_(hindrances),
        tasks_(detail::tasks_of(plan, context.segmentation)) {}

  Generalised run() {
    while (true) {
      const std::size_t failures = failed_.size() + unpushed_.size();
      Generalised out = attempt();
      if (failed_.size() + unpushed_.size() > failures) {
        if (context_.has_no_work_left()) return nothing_carried_out(context_, plan_);
        continue;
      }
      draw_followers(out);
      for (const auto& [id, refused] : failed_) out.refused.push_back(refused);
      std::ranges::sort(out.refused, {}, &RefusedStep::feature);
      add_along(out);
      return out;
    }
  }

 private:
  void fail(const Step& step, Code code, const std::string& reason) {
    RefusedStep refused{step.feature, code, reason};
    if (code == Code::G403)
      if (const auto known = hindrances_.find(step.feature); known != hindrances_.end())
        refused.hindrance = known->second;
    failed_.try_emplace(step.feature, std::move(refused));
  }
  void fail(const detail::PlanTask& task, Code code, const std::string& reason) {
    for (const Step& step : task.steps) fail(step, code, reason);
  }
  void fail(const detail::PlanTask& task, const detail::Placed& placed) {
    const auto code_of = [](bool is_needless) { return is_needless ? Code::none : Code::G403; };
    if (placed.left.empty()) return fail(task, code_of(placed.is_needless), placed.reason);
    for (const detail::Placed::LeftMember& one : placed.left)
      fail(task.steps[one.member], code_of(one.is_needless), one.reason);
  }

  /// What hinders the operator is looked for once.
  [[nodiscard]] bool wants_hindrance(const detail::PlanTask& task) const {
    return std::ranges::any_of(
        task.steps, [&](const Step& step) { return !hindrances_.contains(step.feature); });
  }
  void keep_hindrance(const detail::PlanTask& task, const Operator& its, const Redrawing& asked,
                      const detail::Placed& placed) const {
    for (const detail::Placed::LeftMember& one : placed.left)
      if (!one.is_needless) hindrances_.try_emplace(task.steps[one.member].feature, one.hindrance);
    if (!placed.left.empty() || placed.is_needless) return;
    const Hindrance found = HindranceFinder(its, asked).run();
    for (const Step& step : task.steps) hindrances_.try_emplace(step.feature, found);
  }

  /// Takes everything off and puts back what operators leave; what fails is not tried again.
  Generalised attempt() {
    Plan off = everything_off();
    const std::vector<detail::Push> pushes = add_pushed(off);
    pushed_.clear();
    for (const detail::Push& push : pushes)
      pushed_.insert(pushed_.end(), push.pushed.begin(), push.pushed.end());
    Remainder remainder = omit(context_, off);
    Generalised out{std::move(remainder.solid), std::move(remainder.removed), {}};
    for (const detail::PlanTask& task : tasks_) fail_if_refused(task, remainder.refused);
    for (const Refusal& refusal : remainder.refused)
      if (is_pushed(refusal.feature, pushes))
        unpushed_.insert(refusal.feature);
      else
        keep_refusal(refusal, out);
    // What others make room for comes first, and then they.
    const auto pushes_others = [&](const detail::PlanTask& task) {
      return std::ranges::any_of(pushes, [&](const detail::Push& push) {
        return std::ranges::find(push.by, task.steps[0].feature, &Step::feature) != push.by.end();
      });
    };
    for (const detail::PlanTask& task : tasks_)
      if (pushes_others(task)) put_back(task, out);
    for (const detail::Push& push : pushes) put_aside(push, out);
    for (const detail::PlanTask& task : tasks_)
      if (!pushes_others(task)) put_back(task, out);
    return out;
  }

  /// Takes off what has a step and what goes along with it.
  [[nodiscard]] Plan everything_off() const {
    std::map<FeatureId, Step> steps;
    for (const Step& step : plan_.steps) {
      if (failed_.contains(step.feature) || step.operation == "merge") continue;
      for (const FeatureId id : step.with) steps.try_emplace(id, Step{id, "omit", step.rule});
      steps.insert_or_assign(step.feature, step);
    }
    Plan off{plan_.scale, {}, {}};
    for (auto& [id, step] : steps) {
      step.operation = "omit";
      off.steps.push_back(std::move(step));
    }
    return off;
  }

  /// Of what goes along with another nothing is told: it stays.
  void keep_refusal(const Refusal& refusal, Generalised& out) {
    const auto step = std::ranges::find(plan_.steps, refusal.feature, &Step::feature);
    if (step == plan_.steps.end() || failed_.contains(refusal.feature)) return;
    if (step->with.empty())
      out.refused.push_back({refusal.feature, refusal.code, refusal.reason});
    else
      fail({step->operation, {*step}}, refusal.code, refusal.reason);  // nothing goes along
  }

  static bool is_pushed(FeatureId id, const std::vector<detail::Push>& pushes) {
    return std::ranges::any_of(pushes, [&](const detail::Push& push) {
      return std::ranges::find(push.pushed, id, &Step::feature) != push.pushed.end();
    });
  }

  /// It is as its operator wants it, and so there to be pushed.
  [[nodiscard]] bool is_kept(FeatureId id) const {
    const auto failed = failed_.find(id);
    return failed != failed_.end() && failed->second.code == Code::none;
  }

  /// What makes room is taken off as well.
  [[nodiscard]] std::vector<detail::Push> add_pushed(Plan& off) const {
    std::vector<Step> pushing;
    std::ranges::copy_if(plan_.steps, std::back_inserter(pushing), [&](const Step& step) {
      return step.openings && !failed_.contains(step.feature);
    });
    if (pushing.empty()) return {};
    std::vector<FeatureId> excluded(unpushed_.begin(), unpushed_.end());
    for (const Step& step : plan_.steps) {
      if (!is_kept(step.feature)) excluded.push_back(step.feature);
      excluded.insert(excluded.end(), step.with.begin(), step.with.end());
    }
    std::ranges::sort(excluded);
    auto pushes = detail::pushes_of(segmentation_, pushing, plan_.scale, excluded);
    for (detail::Push& push : pushes)
      for (Step& step : push.pushed) {
        take_off(step.feature, off);
        const auto& belonging = push.by.front().follows_pushed;
        if (!belonging || !belonging->contains(step.feature)) continue;
        step.belonging = push.by.front().belonging;
        step.with = step.follows = belonging->at(step.feature);
        for (const FeatureId id : step.with) take_off(id, off);
      }
    std::ranges::sort(off.steps, {}, &Step::feature);
    return pushes;
  }

  static void take_off(FeatureId id, Plan& off) {
    if (std::ranges::find(off.steps, id, &Step::feature) == off.steps.end())
      off.steps.push_back({id, "omit", {}});
  }

  /// Puts what made room back, beside what has grown. What cannot be put back so is in the way
  /// after all.
  void put_aside(const detail::Push& push, Generalised& out) {
    std::vector<Step> some;
    for (const Step& step : push.pushed)
      if (std::ranges::binary_search(out.removed, step.feature) && !went_with_another(step, out))
        some.push_back(step);
    if (some.empty()) return;
    if (!may_draw(some.size(), out.solid)) {
      unpushed_.insert(some.front().feature);
      return;
    }
    detail::Placed placed =
        detail::push_aside({out.solid, segmentation_, some, plan_.scale}, push.by);
    for (const detail::Placed::LeftMember& one : placed.left)
      unpushed_.insert(some[one.member].feature);
    if (!placed.solid) return;
    out.solid = std::move(*placed.solid);
    for (const Step& step : some) {
      std::erase(out.removed, step.feature);
      out.changed.push_back(step.feature);
      out.pushed.push_back({step.feature, nearest_of(push.by, step.feature)});
    }
    std::ranges::sort(out.changed);
  }

  /// The one whose middle is nearest.
  [[nodiscard]] FeatureId nearest_of(const std::vector<Step>& steps, FeatureId id) const {
    const auto middle = [&](FeatureId of) {
      const Box& box = segmentation_.features[of.index()].box;
      return 0.5 * (box.min + box.max);
    };
    return std::ranges::min_element(
               steps, {},
               [&](const Step& step) { return length(middle(step.feature) - middle(id)); })
        ->feature;
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
  void merge_in(const detail::PlanTask& task, Generalised& out) {
    const FeatureId id = task.steps[0].feature;
    if (failed_.contains(id) || std::ranges::binary_search(out.removed, id)) return;
    detail::Placed placed = merge({out.solid, segmentation_, task.steps, plan_.scale});
    if (!placed.solid) return fail(task, Code::G403, placed.reason);
    out.solid = std::move(*placed.solid);
    out.changed.push_back(id);
    std::ranges::sort(out.changed);
  }

  void put_back(const detail::PlanTask& planned, Generalised& out) {
    if (planned.operation == "merge") return merge_in(planned, out);
    detail::PlanTask task = without_failed(planned);
    const auto can_be_put_back = [&](const Step& step) {
      return std::ranges::binary_search(out.removed, step.feature) && !went_with_another(step, out);
    };
    if (detail::takes_some(planned.steps[0]))
      std::erase_if(task.steps, [&](const Step& step) { return !can_be_put_back(step); });
    else if (!std::ranges::all_of(task.steps, can_be_put_back))
      return;
    if (!task.steps.empty()) redraw(task, out);
  }

  /// It went with what carries it, unless that belongs to it, as a frame does.
  [[nodiscard]] bool went_with_another(const Step& step, const Generalised& out) const {
    const auto is_gone = [&](FeatureId id) {
      return id.is_valid() && std::ranges::binary_search(out.removed, id) &&
             !std::ranges::binary_search(step.with, id);
    };
    return is_gone(context_.feature(step.feature).parent) ||
           is_gone(context_.feature(step.feature).host);
  }

  /// Counts what drawing so many features takes, with what is tried before one fits.
  [[nodiscard]] bool may_draw(std::size_t features, const Solid& solid) const {
    return context_.may_go_on(solid, 1 + static_cast<std::int64_t>(features) / kDrawnPerStep);
  }

  void redraw(const detail::PlanTask& task, Generalised& out) {
    const Operator& its = operator_named(task.operation);
    if (!may_draw(task.steps.size(), out.solid)) return fail(task, Code::E502, kNoWorkLeft);
    const bool tells_needs = wants_hindrance(task);
    const Redrawing asked{out.solid, segmentation_, task.steps, plan_.scale, tells_needs};
    detail::Placed placed = its.redraw(asked);
    if (!placed.solid) {
      if (tells_needs && may_draw(kTriesForNeeds * task.steps.size(), out.solid))
        keep_hindrance(task, its, asked, placed);
      return fail(task, placed);
    }
    if (task.operation == "flatten" && context_.judge != nullptr &&
        context_.judge->fitness_of(*placed.solid) == Fitness::unfit)
      return fail(task, Code::G403, "the moved facet would meet another part");
    out.solid = std::move(*placed.solid);
    std::vector<Step> stay = task.steps;
    if (placed.stays) {
      stay.clear();
      for (const std::size_t member : *placed.stays) stay.push_back(task.steps[member]);
    }
    for (const Step& step : stay) {
      std::erase(out.removed, step.feature);
      out.changed.push_back(step.feature);
    }
    std::ranges::sort(out.changed);
    for (const Step& step : task.steps)
      if (!stay.empty() && std::ranges::binary_search(out.removed, step.feature))
        out.along.push_back({step.feature, nearest_of(stay, step.feature)});
  }

  /// By feature what is to be drawn again beside openings: their steps.
  using StepsOfFollower = std::map<FeatureId, std::vector<const Step*>>;

  [[nodiscard]] StepsOfFollower followers_of(const Generalised& out) const {
    StepsOfFollower found;
    const auto add = [&](const Step& step) {
      for (const FeatureId id : step.follows)
        if (std::ranges::binary_search(out.removed, id)) found[id].push_back(&step);
    };
    for (const Step& step : plan_.steps)
      if (!failed_.contains(step.feature)) add(step);
    for (const Step& step : pushed_)
      if (!unpushed_.contains(step.feature)) add(step);
    for (const Step& step : plan_.steps)
      if (!failed_.contains(step.feature)) found.erase(step.feature);
    return found;
  }

  /// Draws what belongs to openings again; what cannot be drawn goes along with them.
  void draw_followers(Generalised& out) const {
    const StepsOfFollower followers = followers_of(out);
    if (followers.empty() || out.changed.empty()) return;
    const auto drawn = detail::drawn_corners(out.solid, segmentation_, out.changed);
    for (const auto& [id, steps] : followers) draw_follower(id, steps, drawn, out);
    std::ranges::sort(out.changed);
  }

  void draw_follower(FeatureId id, const std::vector<const Step*>& steps,
                     const detail::DrawnCorners& drawn, Generalised& out) const {
    detail::Follower follower{id, {}, steps[0]->belonging, 0};
    std::vector<FeatureId> own;
    FeatureId with;
    for (const Step* step : steps) {
      follower.openings.push_back(step->feature);
      own.push_back(step->feature);
      own.insert(own.end(), step->follows.begin(), step->follows.end());
      if (!with.is_valid() && drawn.contains(step->feature)) with = step->feature;
      follower.is_of_strip |= step->operation == "aggregate" && !becomes_block(*step);
    }
    if (!with.is_valid() || went_with_another({id, {}, {}}, out)) return;
    follower.gap_m = Redrawing{out.solid, segmentation_, {*steps[0]}, plan_.scale}.gap_m();
    detail::Followed found = detail::follow(out.solid, segmentation_, follower, drawn, own);
    if (!found.placed.solid) {
      out.along.push_back({id, with, std::move(found.placed.reason), std::move(found.beside)});
      return;
    }
    out.solid = std::move(*found.placed.solid);
    std::erase(out.removed, id);
    out.changed.push_back(id);
    out.following.push_back({id, with, follower.belonging, found.box});
  }

  static bool leaves_for_good(const Step& step) {
    return step.operation == "omit" || step.operation == "flatten";
  }

  /// After what stands for rows: what belongs to features that left their places, and then what was
  /// on or in others.
  void add_along(Generalised& out) const {
    const auto has_left = [&](FeatureId id) {
      return id.is_valid() && (std::ranges::binary_search(out.removed, id) ||
                               std::ranges::binary_search(out.changed, id));
    };
    std::map<FeatureId, AlongFeature> with;
    const auto add = [&](FeatureId id, FeatureId other) {
      with.try_emplace(id, AlongFeature{id, other});
    };
    for (const AlongFeature& one : out.along) with.try_emplace(one.feature, one);
    const auto add_all = [&](const Step& step) {
      if (has_left(step.feature))
        for (const FeatureId id : step.with) add(id, step.feature);
    };
    for (const Step& step : plan_.steps)
      if (!failed_.contains(step.feature)) add_all(step);
    for (const Step& step : pushed_) add_all(step);
    for (const FeatureId id : out.removed) {
      const Feature& its = segmentation_.features[id.index()];
      if (has_left(its.parent)) add(id, its.parent);
      if (has_left(its.host)) add(id, its.host);
    }
    for (const Step& step : plan_.steps)
      if (!failed_.contains(step.feature) && leaves_for_good(step)) with.erase(step.feature);
    out.along.clear();
    for (auto& [id, one] : with)
      if (std::ranges::binary_search(out.removed, id)) out.along.push_back(std::move(one));
  }

  [[nodiscard]] detail::PlanTask without_failed(detail::PlanTask task) const {
    std::erase_if(task.steps, [&](const Step& step) { return failed_.contains(step.feature); });
    return task;
  }

  const RedrawContext& context_;
  const Segmentation& segmentation_;
  const Plan& plan_;
  std::map<FeatureId, Hindrance>& hindrances_;
  std::vector<detail::PlanTask> tasks_;
  std::map<FeatureId, RefusedStep> failed_;
  std::set<FeatureId> unpushed_;  ///< they stay where they are
  std::vector<Step> pushed_{};    ///< what makes room, in the last attempt
};

}  // namespace

Generalised nothing_carried_out(const RedrawContext& context, const Plan& plan) {
  Generalised out{context.solid, {}};
  const std::string reason = kNoWorkLeft;
  for (const Step& step : plan.steps) out.refused.push_back({step.feature, Code::E502, reason});
  std::ranges::sort(out.refused, {}, &RefusedStep::feature);
  return out;
}

Generalised carry_out_steps(const RedrawContext& context, const Plan& plan,
                            std::map<FeatureId, Hindrance>& hindrances) {
  return StepRunner(context, plan, hindrances).run();
}

}  // namespace oriel
