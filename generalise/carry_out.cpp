#include "generalise/carry_out.h"

#include "generalise/invariants/fineness.h"
#include "generalise/invariants/stays.h"
#include "generalise/removal/carries.h"
#include "generalise/removal/clear_edges.h"
#include "generalise/steps.h"
#include "generalise/tasks.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::carry_out_steps;

class Guard {
 public:
  Guard(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
        const SegmentOptions& options, const Invariants& invariants, const Pieces& pieces)
      : solid_(solid),
        segmentation_(segmentation),
        plan_(plan),
        options_(options),
        invariants_(invariants),
        pieces_(pieces),
        before_(measures_of(solid, invariants)),
        judge_(invariants.judge) {
    judge_.settled = invariants.settled;
    judge_.violation_of = [this](const Solid& left) {
      return violation(before_, measures_of(left, invariants_), invariants_);
    };
  }

  CarriedOut run() {
    while (true) {
      CarriedOut out = first(plan_.steps.size());
      const auto broken = violation(before_, measures_of(out.solid, invariants_), invariants_);
      if (!broken && !undo_fine(out) && !undo_torn(out) && !undo_carrying(out))
        return with_undone(cleared(std::move(out)));
      if (!broken) continue;
      if (undone_.size() == plan_.steps.size()) return with_undone(std::move(out));
      undone_.push_back(culprit(*broken));
    }
  }

 private:
  [[nodiscard]] bool is_undone(FeatureId id) const {
    return std::ranges::find(undone_, id, &CarriedOut::Refused::feature) != undone_.end();
  }

  [[nodiscard]] bool is_settled(FeatureId id) const {
    return std::ranges::binary_search(invariants_.settled, id);
  }

  /// What the first steps make, without those that were undone.
  [[nodiscard]] CarriedOut first(std::size_t count) const {
    Plan some{plan_.scale, {}, {}};
    for (std::size_t i = 0; i < count; ++i)
      if (!is_undone(plan_.steps[i].feature)) some.steps.push_back(plan_.steps[i]);
    return carry_out_steps(solid_, segmentation_, some, options_, judge_);
  }

  /// Takes back what draws an edge that is too short; false if nothing does.
  bool undo_fine(const CarriedOut& out) {
    if (invariants_.least_edge_m <= 0 || out.changed.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge : short_edges_of_drawn(solid_, out.solid, segmentation_, out.changed,
                                                      out.removed, invariants_.least_edge_m))
      if (!is_undone(edge.feature) && !is_settled(edge.feature))
        undo_task(edge.feature, fmt::format("an edge of {:.2f} m would be drawn", edge.length_m));
    return undone_.size() > count;
  }

  /// With all that is drawn together with the feature.
  void undo_task(FeatureId id, const std::string& reason) {
    for (const detail::PlanTask& task : detail::tasks_of(plan_, segmentation_))
      if (std::ranges::find(task.steps, id, &Step::feature) != task.steps.end())
        for (const Step& step : task.steps)
          if (!is_undone(step.feature)) undone_.push_back({step.feature, Code::G403, reason});
  }

  /// Takes back what tears a piece off; false if nothing does.
  bool undo_torn(const CarriedOut& out) {
    if (invariants_.least_edge_m <= 0 || pieces_.may_stay.empty()) return false;
    const std::size_t count = undone_.size();
    for (const ShortEdge& edge :
         new_short_edges(solid_, out.solid, segmentation_, out.removed, invariants_.least_edge_m))
      for (const Step& step : plan_.steps)
        if (std::ranges::binary_search(pieces_.may_stay, step.feature) &&
            std::ranges::binary_search(out.removed, step.feature) && !is_undone(step.feature) &&
            !is_settled(step.feature) && is_torn(step.feature, edge))
          undone_.push_back({step.feature, Code::G418,
                             fmt::format("an edge of {:.2f} m would be left", edge.length_m)});
    return undone_.size() > count;
  }

  /// Takes back what leaves something hanging that the piece carried; false if nothing does.
  bool undo_carrying(const CarriedOut& out) {
    const std::size_t count = undone_.size();
    for (const Step& step : plan_.steps)
      if (std::ranges::binary_search(pieces_.may_stay, step.feature) &&
          std::ranges::binary_search(out.removed, step.feature) && !is_undone(step.feature) &&
          !is_settled(step.feature) && stays_as_it_was(parent_of(step.feature), out) &&
          detail::carries_its_parent(segmentation_, step.feature))
        undone_.push_back({step.feature, Code::G411, "what stands on it would hang in the air"});
    return undone_.size() > count;
  }

  [[nodiscard]] FeatureId parent_of(FeatureId id) const {
    return segmentation_.features[id.index()].parent;
  }

  /// Neither removed nor, with something around it, drawn anew, as a chimney that becomes a block.
  [[nodiscard]] bool stays_as_it_was(FeatureId id, const CarriedOut& out) const {
    if (!id.is_valid() || std::ranges::binary_search(out.removed, id)) return false;
    for (; id.is_valid(); id = parent_of(id))
      if (std::ranges::binary_search(out.changed, id)) return false;
    return true;
  }

  /// The edge is where the piece was torn off what stays; of the body it is if the piece covered it
  /// whole. Its ends may be off by what facets of one plane are.
  [[nodiscard]] bool is_torn(FeatureId piece, const ShortEdge& edge) const {
    const double off_m = options_.tolerances.plane_offset_m;
    const Box& box = segmentation_.features[piece.index()].box;
    const int held = holds(box, edge.from, off_m) + holds(box, edge.to, off_m);
    if (!edge.feature.is_valid()) return held == 2;
    if (edge.length_m > pieces_.c_m[piece.index()] + 2 * off_m || held == 0) return false;
    return pieces_.c_m[edge.feature.index()] < invariants_.least_edge_m ||
           detail::is_within(segmentation_, piece, edge.feature);
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
    order.keeps_facet = [&](const Solid& solid, const Facet& facet) {
      return detail::why_it_stays(solid, facet, segmentation_, out.removed);
    };
    Cleared cleared = clear_edges(std::move(out.solid), order, judge_);
    out.solid = std::move(cleared.solid);
    out.uncleared = std::move(cleared.left);
    return out;
  }

  /// The first `good` steps break nothing, the first `bad` do.
  [[nodiscard]] CarriedOut::Refused culprit(Violation reason) const {
    std::size_t good = 0, bad = plan_.steps.size();
    while (bad - good > 1) {
      const std::size_t middle = good + (bad - good) / 2;
      const auto broken =
          violation(before_, measures_of(first(middle).solid, invariants_), invariants_);
      (broken ? bad : good) = middle;
      if (broken) reason = *broken;
    }
    return {plan_.steps[bad - 1].feature, reason.code, std::move(reason.sentence)};
  }

  [[nodiscard]] CarriedOut with_undone(CarriedOut out) const {
    out.refused.insert(out.refused.end(), undone_.begin(), undone_.end());
    std::ranges::stable_sort(out.refused, {}, &CarriedOut::Refused::feature);
    return out;
  }

  const Solid& solid_;
  const Segmentation& segmentation_;
  const Plan& plan_;
  const SegmentOptions& options_;
  const Invariants& invariants_;
  const Pieces& pieces_;
  Measures before_;
  Judge judge_;
  std::vector<CarriedOut::Refused> undone_;
};

}  // namespace

CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants,
                     const Pieces& pieces) {
  return Guard(solid, segmentation, plan, options, invariants, pieces).run();
}

}  // namespace oriel
