#include "generalise/carry_out.h"

#include "generalise/invariants/fineness.h"
#include "generalise/removal/clear_edges.h"
#include "generalise/tasks.h"
#include "interpret/score/significance.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/directions.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// The feature is `outer`, or was found in its subtree.
bool is_within(const Segmentation& segmentation, FeatureId id, FeatureId outer) {
  while (id.is_valid() && id != outer) id = segmentation.features[id.index()].parent;
  return id.is_valid();
}

/// What the feature is a piece of stands on it: the cut between the two looks down, and the piece
/// stands on something else itself, so no surface of its own looks down. Such is the wedge under a
/// chimney across a ridge, cut along one slope, over the other slope; a console is not, its lower
/// side is free.
bool carries_its_parent(const Segmentation& segmentation, FeatureId id) {
  const Feature& feature = segmentation.features[id.index()];
  const auto is_below = [&](PlaneId plane) {
    return looks_down(segmentation.planes[plane.index()].normal);
  };
  if (feature.sense != Sense::protrusion || !feature.parent.is_valid() || feature.planes.empty() ||
      !is_below(feature.planes[0]))
    return false;
  // Facets without polygons are caps.
  const auto is_lower_side = [&](const Facet& facet) {
    return !facet.polygons.empty() && is_below(facet.plane);
  };
  return std::ranges::none_of(segmentation.cells, [&](const Cell& cell) {
    return cell.sign > 0 && is_within(segmentation, cell.feature, id) &&
           std::ranges::any_of(cell.facets, is_lower_side);
  });
}

/// Neither removed nor, with something around it, drawn anew, as a chimney that becomes a block.
bool stays_as_it_was(const Segmentation& segmentation, FeatureId id, const Generalised& out) {
  if (!id.is_valid() || std::ranges::binary_search(out.removed, id)) return false;
  for (; id.is_valid(); id = segmentation.features[id.index()].parent)
    if (std::ranges::binary_search(out.changed, id)) return false;
  return true;
}

/// The number of the step by which something breaks: with the first `good` ones nothing does, with
/// all of them something does. What breaks after others is mostly near them: after some good steps
/// it is looked for in strides that grow.
template <class Breaks>
std::size_t first_to_break(std::size_t good, std::size_t count, const Breaks& breaks) {
  std::size_t bad = count;
  for (std::size_t stride = 1; good > 0 && good + stride < bad; stride *= 2)
    if (breaks(good + stride))
      bad = good + stride;
    else
      good += stride;
  while (bad - good > 1) {
    const std::size_t middle = good + (bad - good) / 2;
    (breaks(middle) ? bad : good) = middle;
  }
  return bad - 1;
}

/// The steps of a plan that were taken back, with their reasons. Refers to the plan.
class UndoneSteps {
 public:
  explicit UndoneSteps(const Plan& plan) : plan_(plan) {}

  [[nodiscard]] bool contains(FeatureId id) const {
    return std::ranges::find(undone_, id, &RefusedStep::feature) != undone_.end();
  }
  [[nodiscard]] std::size_t size() const { return undone_.size() + unfollowed_.size(); }
  [[nodiscard]] bool has_all() const { return undone_.size() == plan_.steps.size(); }

  void add(RefusedStep step) { undone_.push_back(std::move(step)); }

  /// What follows the openings of a step, and those that it pushes, is not drawn again. False if
  /// nothing follows them.
  bool add_unfollowed(FeatureId id, const std::string& reason) {
    const auto step = std::ranges::find(plan_.steps, id, &Step::feature);
    const bool has_followers =
        step != plan_.steps.end() && (!step->follows.empty() || (step->follows_pushed != nullptr));
    return has_followers && unfollowed_.emplace(id, reason).second;
  }

  /// The first `count` steps of the plan, without those that were taken back.
  [[nodiscard]] Plan first(std::size_t count) const {
    Plan some{plan_.scale, {}, {}};
    for (std::size_t i = 0; i < count; ++i) {
      if (contains(plan_.steps[i].feature)) continue;
      some.steps.push_back(plan_.steps[i]);
      // What has to stay does not go along either.
      std::erase_if(some.steps.back().with, [&](FeatureId id) { return contains(id); });
      if (!unfollowed_.contains(some.steps.back().feature)) continue;
      some.steps.back().follows.clear();
      some.steps.back().follows_pushed.reset();
    }
    return some;
  }

  /// What was carried out, with the steps that were taken back among the refused.
  [[nodiscard]] Generalised added_to(Generalised out) const {
    out.refused.insert(out.refused.end(), undone_.begin(), undone_.end());
    std::ranges::stable_sort(out.refused, {}, &RefusedStep::feature);
    for (AlongFeature& one : out.along)
      for (const auto& [id, reason] : unfollowed_) {
        const auto step = std::ranges::find(plan_.steps, id, &Step::feature);
        if (std::ranges::binary_search(step->follows, one.feature) && one.reason.empty())
          one.reason = reason;
      }
    return out;
  }

 private:
  const Plan& plan_;
  std::vector<RefusedStep> undone_;
  std::map<FeatureId, std::string> unfollowed_{};
};

/// Features that may be pieces of something larger: a plinth, the eaves, a parapet.
struct Pieces {
  /// What is to be taken off for its size only, or has no name. Ascending.
  std::vector<FeatureId> may_stay;
  /// By feature its shortest extent, the paper's c; infinite where it is not known.
  std::vector<double> c_m;
};

Pieces pieces_of(const RedrawContext& context, const Plan& plan) {
  Pieces pieces;
  for (const Step& step : plan.steps)
    if (step.operation == "omit" && is_piece(step, context.interpretation))
      pieces.may_stay.push_back(step.feature);
  std::ranges::sort(pieces.may_stay);
  for (const FeatureId id : ids_below<FeatureId>(context.table.rows()))
    pieces.c_m.push_back(context.table.number(id, Attribute::c).value_or(Box::kInfinity));
  return pieces;
}

/// The context with what is found and measured once for all that is tried with it.
RedrawContext prepared(RedrawContext context) {
  context.before = measures_of(context.solid, context.invariants);
  context.cells = context.shared_cells();
  return context;
}

/// Carries a plan out and takes steps back until nothing is violated.
class StepLoop {
 public:
  StepLoop(const RedrawContext& context, const Plan& plan)
      : context_(prepared(context)),
        plan_(plan),
        tasks_(detail::tasks_of(plan, context.segmentation)),
        pieces_(pieces_of(context, plan)),
        undone_(plan) {}

  Generalised run() {
    while (true) {
      Generalised out = carry_out_first(plan_.steps.size());
      if (auto broken = context_.violation_by(out.solid)) {
        if (undone_.has_all()) return undone_.added_to(std::move(out));
        if (context_.has_no_work_left()) return nothing_carried_out(context_, plan_);
        undo_violating(std::move(*broken));
      } else if (!undo_drawn_too_fine(out) && !undo_torn(out) && !undo_carrying(out)) {
        if (least_m() > 0) out = clear_edges(context_, std::move(out));
        return undone_.added_to(std::move(out));
      } else if (context_.has_no_work_left()) {
        return nothing_carried_out(context_, plan_);
      }
    }
  }

 private:
  /// What the first steps make, without those that were taken back.
  Generalised carry_out_first(std::size_t count) {
    return carry_out_steps(context_, undone_.first(count), hindrances_);
  }

  /// The first step by which an invariant is violated; the reason is what it violates.
  void undo_violating(Violation reason) {
    if (sound_undone_ != undone_.size()) sound_ = 0;
    const std::size_t step = first_to_break(sound_, plan_.steps.size(), [&](std::size_t first) {
      auto broken = context_.violation_by(carry_out_first(first).solid);
      if (broken) reason = std::move(*broken);
      return broken.has_value();
    });
    sound_ = step;
    sound_undone_ = undone_.size() + 1;
    const FeatureId id = plan_.steps[step].feature;
    if (undone_.add_unfollowed(id, reason.sentence)) return;
    undone_.add({id, reason.code, std::move(reason.sentence)});
  }

  [[nodiscard]] bool may_be_undone(FeatureId id) const {
    return !undone_.contains(id) && !std::ranges::binary_search(context_.settled, id);
  }

  /// It was taken off as a piece, and may stay.
  [[nodiscard]] bool is_removed_piece(FeatureId id, const Generalised& out) const {
    return std::ranges::binary_search(pieces_.may_stay, id) &&
           std::ranges::binary_search(out.removed, id) && may_be_undone(id);
  }

  /// Takes back what draws an edge that is too short; false if nothing does.
  bool undo_drawn_too_fine(const Generalised& out) {
    if (least_m() <= 0 || out.changed.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge : short_edges_of_drawn(context_, out, least_m()))
      if (const FeatureId id = cause_of(edge.feature, out);
          may_be_undone(id) && !is_beside_follower(edge, out)) {
        const std::string reason = fmt::format("an edge of {:.2f} m would be drawn", edge.length_m);
        if (!undone_.add_unfollowed(id, reason)) undo_task(id, reason);
      }
    return undone_.size() > count;
  }

  /// It is between an opening and what follows that: it overhangs it as before.
  static bool is_beside_follower(const ShortEdge& edge, const Generalised& out) {
    return std::ranges::any_of(out.following, [&](const FollowingFeature& one) {
      return contains(one.box, edge.from, kOnBox_m) && contains(one.box, edge.to, kOnBox_m);
    });
  }

  /// What it follows, and what pushed that, if anything did.
  static FeatureId cause_of(FeatureId id, const Generalised& out) {
    const auto follows = std::ranges::find(out.following, id, &FollowingFeature::feature);
    if (follows != out.following.end()) id = follows->with;
    const auto pushed = std::ranges::find(out.pushed, id, &PushedFeature::feature);
    return pushed == out.pushed.end() ? id : pushed->by;
  }

  /// With all that is drawn together with the feature.
  void undo_task(FeatureId id, const std::string& reason) {
    for (const detail::PlanTask& task : tasks_) {
      if (std::ranges::find(task.steps, id, &Step::feature) == task.steps.end()) continue;
      for (const Step& step : task.steps)
        if (!undone_.contains(step.feature) && (step.feature == id || !detail::takes_some(step)))
          undone_.add({step.feature, Code::G403, reason});
    }
  }

  /// Takes back what tears a piece off; false if nothing does.
  bool undo_torn(const Generalised& out) {
    if (least_m() <= 0 || pieces_.may_stay.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge : new_short_edges(context_, out.solid, out.removed, least_m()))
      for (const Step& step : plan_.steps)
        if (is_removed_piece(step.feature, out) && is_torn(step.feature, edge))
          undone_.add({step.feature, Code::G418,
                       fmt::format("an edge of {:.2f} m would be left", edge.length_m)});
    return undone_.size() > count;
  }

  /// Takes back what leaves something hanging that the piece carried; false if nothing does.
  bool undo_carrying(const Generalised& out) {
    const std::size_t count = undone_.size();
    for (const Step& step : plan_.steps)
      if (is_removed_piece(step.feature, out) &&
          stays_as_it_was(context_.segmentation,
                          context_.segmentation.features[step.feature.index()].parent, out) &&
          carries_its_parent(context_.segmentation, step.feature))
        undone_.add({step.feature, Code::G411, "what stands on it would hang in the air"});
    return undone_.size() > count;
  }

  /// The edge is where the piece was torn off what stays; of the body it is if the piece covered it
  /// whole. Its ends may be off by what facets of one plane are.
  [[nodiscard]] bool is_torn(FeatureId piece, const ShortEdge& edge) const {
    const double off_m = context_.options.tolerances.plane_offset_m;
    const Box& box = context_.segmentation.features[piece.index()].box;
    const int held = contains(box, edge.from, off_m) + contains(box, edge.to, off_m);
    if (!edge.feature.is_valid()) return held == 2;
    if (edge.length_m > pieces_.c_m[piece.index()] + 2 * off_m || held == 0) return false;
    return pieces_.c_m[edge.feature.index()] < least_m() ||
           is_within(context_.segmentation, piece, edge.feature);
  }

  [[nodiscard]] double least_m() const { return context_.invariants.least_edge_m; }

  const RedrawContext context_;
  const Plan& plan_;
  const std::vector<detail::PlanTask> tasks_;
  const Pieces pieces_;
  std::map<FeatureId, Hindrance> hindrances_;
  UndoneSteps undone_;
  /// By so many of the first steps nothing is violated, while so many are undone.
  std::size_t sound_ = 0, sound_undone_ = 0;
};

}  // namespace

bool is_piece(const Step& step, const Interpretation& interpretation) {
  return interpretation.verdicts[step.feature.index()].label.empty() ||
         is_verdict_of_size(step.rule.substr(step.rule.find('/') + 1));
}

Generalised carry_out(const RedrawContext& context, const Plan& plan) {
  return StepLoop(context, plan).run();
}

}  // namespace oriel
