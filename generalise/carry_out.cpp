#include "generalise/carry_out.h"

#include "generalise/invariants/fineness.h"
#include "generalise/invariants/stays.h"
#include "generalise/removal/clear_edges.h"
#include "generalise/removal/facets.h"
#include "generalise/tasks.h"
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
bool stays_as_it_was(const Segmentation& segmentation, FeatureId id, const CarriedOut& out) {
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
    return std::ranges::find(undone_, id, &CarriedOut::Refused::feature) != undone_.end();
  }
  [[nodiscard]] std::size_t size() const { return undone_.size() + unfollowed_.size(); }
  [[nodiscard]] bool has_all() const { return undone_.size() == plan_.steps.size(); }

  void add(CarriedOut::Refused step) { undone_.push_back(std::move(step)); }

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
  [[nodiscard]] CarriedOut added_to(CarriedOut out) const {
    out.refused.insert(out.refused.end(), undone_.begin(), undone_.end());
    std::ranges::stable_sort(out.refused, {}, &CarriedOut::Refused::feature);
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
  std::vector<CarriedOut::Refused> undone_;
  std::map<FeatureId, std::string> unfollowed_{};
};

/// Carries a plan out and takes steps back until nothing is violated.
class InvariantEnforcer {
 public:
  InvariantEnforcer(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                    const SegmentOptions& options, const Invariants& invariants,
                    const Pieces& pieces)
      : solid_(solid),
        segmentation_(segmentation),
        plan_(plan),
        options_(options),
        invariants_(invariants),
        pieces_(pieces),
        before_(measures_of(solid, invariants)),
        validator_(invariants.validator),
        undone_(plan) {
    validator_.settled = invariants.settled;
    validator_.work = invariants.work;
    validator_.complex = std::make_shared<std::optional<CellComplex>>();
    validator_.hindrances = std::make_shared<std::map<FeatureId, Hindrance>>();
    validator_.violation_of = [this](const Solid& left) { return violation_by(left); };
  }

  CarriedOut run() {
    while (true) {
      CarriedOut out = carry_out_first(plan_.steps.size());
      if (auto broken = violation_by(out.solid)) {
        if (undone_.has_all()) return undone_.added_to(std::move(out));
        if (is_used_up(invariants_.work)) return nothing_carried_out(solid_, plan_);
        undo_violating(std::move(*broken));
      } else if (!undo_drawn_too_fine(out) && !undo_torn(out) && !undo_carrying(out)) {
        return undone_.added_to(cleared(std::move(out)));
      } else if (is_used_up(invariants_.work)) {
        return nothing_carried_out(solid_, plan_);
      }
    }
  }

 private:
  [[nodiscard]] std::optional<Violation> violation_by(const Solid& left) const {
    return violation(before_, measures_of(left, invariants_), invariants_);
  }

  /// What the first steps make, without those that were taken back.
  [[nodiscard]] CarriedOut carry_out_first(std::size_t count) const {
    return carry_out_steps(solid_, segmentation_, undone_.first(count), options_, validator_);
  }

  /// The first step by which an invariant is violated; the reason is what it violates.
  void undo_violating(Violation reason) {
    if (sound_undone_ != undone_.size()) sound_ = 0;
    const std::size_t step = first_to_break(sound_, plan_.steps.size(), [&](std::size_t first) {
      auto broken = violation_by(carry_out_first(first).solid);
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
    return !undone_.contains(id) && !std::ranges::binary_search(invariants_.settled, id);
  }

  /// It was taken off as a piece, and may stay.
  [[nodiscard]] bool is_removed_piece(FeatureId id, const CarriedOut& out) const {
    return std::ranges::binary_search(pieces_.may_stay, id) &&
           std::ranges::binary_search(out.removed, id) && may_be_undone(id);
  }

  /// Takes back what draws an edge that is too short; false if nothing does.
  bool undo_drawn_too_fine(const CarriedOut& out) {
    if (invariants_.least_edge_m <= 0 || out.changed.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge : short_edges_of_drawn(solid_, out.solid, segmentation_, out.changed,
                                                      out.removed, invariants_.least_edge_m))
      if (const FeatureId id = cause_of(edge.feature, out);
          may_be_undone(id) && !is_beside_follower(edge, out)) {
        const std::string reason = fmt::format("an edge of {:.2f} m would be drawn", edge.length_m);
        if (!undone_.add_unfollowed(id, reason)) undo_task(id, reason);
      }
    return undone_.size() > count;
  }

  /// It is between an opening and what follows that: it overhangs it as before.
  static bool is_beside_follower(const ShortEdge& edge, const CarriedOut& out) {
    return std::ranges::any_of(out.following, [&](const FollowingFeature& one) {
      return contains(one.box, edge.from, kOnBox_m) && contains(one.box, edge.to, kOnBox_m);
    });
  }

  /// What it follows, and what pushed that, if anything did.
  static FeatureId cause_of(FeatureId id, const CarriedOut& out) {
    const auto follows = std::ranges::find(out.following, id, &FollowingFeature::feature);
    if (follows != out.following.end()) id = follows->with;
    const auto pushed = std::ranges::find(out.pushed, id, &PushedFeature::feature);
    return pushed == out.pushed.end() ? id : pushed->by;
  }

  /// With all that is drawn together with the feature.
  void undo_task(FeatureId id, const std::string& reason) {
    for (const detail::PlanTask& task : detail::tasks_of(plan_, segmentation_)) {
      if (std::ranges::find(task.steps, id, &Step::feature) == task.steps.end()) continue;
      for (const Step& step : task.steps)
        if (!undone_.contains(step.feature) && (step.feature == id || !detail::takes_some(step)))
          undone_.add({step.feature, Code::G403, reason});
    }
  }

  /// Takes back what tears a piece off; false if nothing does.
  bool undo_torn(const CarriedOut& out) {
    if (invariants_.least_edge_m <= 0 || pieces_.may_stay.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge :
         new_short_edges(solid_, out.solid, segmentation_, out.removed, invariants_.least_edge_m))
      for (const Step& step : plan_.steps)
        if (is_removed_piece(step.feature, out) && is_torn(step.feature, edge))
          undone_.add({step.feature, Code::G418,
                       fmt::format("an edge of {:.2f} m would be left", edge.length_m)});
    return undone_.size() > count;
  }

  /// Takes back what leaves something hanging that the piece carried; false if nothing does.
  bool undo_carrying(const CarriedOut& out) {
    const std::size_t count = undone_.size();
    for (const Step& step : plan_.steps)
      if (is_removed_piece(step.feature, out) &&
          stays_as_it_was(segmentation_, segmentation_.features[step.feature.index()].parent,
                          out) &&
          carries_its_parent(segmentation_, step.feature))
        undone_.add({step.feature, Code::G411, "what stands on it would hang in the air"});
    return undone_.size() > count;
  }

  /// The edge is where the piece was torn off what stays; of the body it is if the piece covered it
  /// whole. Its ends may be off by what facets of one plane are.
  [[nodiscard]] bool is_torn(FeatureId piece, const ShortEdge& edge) const {
    const double off_m = options_.tolerances.plane_offset_m;
    const Box& box = segmentation_.features[piece.index()].box;
    const int held = contains(box, edge.from, off_m) + contains(box, edge.to, off_m);
    if (!edge.feature.is_valid()) return held == 2;
    if (edge.length_m > pieces_.c_m[piece.index()] + 2 * off_m || held == 0) return false;
    return pieces_.c_m[edge.feature.index()] < invariants_.least_edge_m ||
           is_within(segmentation_, piece, edge.feature);
  }

  /// Without new edges that are too short, as far as that can be.
  [[nodiscard]] CarriedOut cleared(CarriedOut out) const {
    if (invariants_.least_edge_m <= 0) return out;
    ClearOrder order;
    order.reach_m = invariants_.least_edge_m;
    order.short_edges_of = [&](const Solid& solid) {
      return without_whole_edges(
          new_short_edges(solid_, solid, segmentation_, out.removed, invariants_.least_edge_m),
          segmentation_, out.changed, out.removed, invariants_.least_edge_m);
    };
    const detail::StayingFeatures staying(segmentation_, out.removed);
    order.keeps_facet = [&](const Solid& solid, const Facet& facet) {
      return staying.why_it_stays(solid, facet);
    };
    Cleared cleared = clear_edges(std::move(out.solid), order, validator_);
    out.solid = std::move(cleared.solid);
    out.uncleared = std::move(cleared.left);
    return out;
  }

  const Solid& solid_;
  const Segmentation& segmentation_;
  const Plan& plan_;
  const SegmentOptions& options_;
  const Invariants& invariants_;
  const Pieces& pieces_;
  Measures before_;
  SolidValidator validator_;
  UndoneSteps undone_;
  /// By so many of the first steps nothing is violated, while so many are undone.
  std::size_t sound_ = 0, sound_undone_ = 0;
};

}  // namespace

CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants,
                     const Pieces& pieces) {
  return InvariantEnforcer(solid, segmentation, plan, options, invariants, pieces).run();
}

}  // namespace oriel
