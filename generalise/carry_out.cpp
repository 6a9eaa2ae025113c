#include "generalise/carry_out.h"

#include "generalise/detail/steps.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

using detail::carry_out_steps;

class Guard {
 public:
  Guard(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
        const SegmentOptions& options, const Invariants& invariants)
      : solid_(solid),
        segmentation_(segmentation),
        plan_(plan),
        options_(options),
        invariants_(invariants),
        before_(measures_of(solid)) {}

  CarriedOut run() {
    while (true) {
      CarriedOut out = first(plan_.steps.size());
      const auto broken = violation(before_, measures_of(out.solid), invariants_);
      if (!broken) return with_undone(std::move(out));
      if (undone_.size() == plan_.steps.size()) return with_undone(std::move(out));
      undone_.push_back(culprit(*broken));
    }
  }

 private:
  [[nodiscard]] bool is_undone(FeatureId id) const {
    return std::ranges::find(undone_, id, &CarriedOut::Refused::feature) != undone_.end();
  }

  /// What the first steps make, without those that were undone.
  [[nodiscard]] CarriedOut first(std::size_t count) const {
    Plan some{plan_.scale, {}, {}};
    for (std::size_t i = 0; i < count; ++i)
      if (!is_undone(plan_.steps[i].feature)) some.steps.push_back(plan_.steps[i]);
    return carry_out_steps(solid_, segmentation_, some, options_, invariants_.is_valid);
  }

  /// The first `good` steps break nothing, the first `bad` do.
  [[nodiscard]] CarriedOut::Refused culprit(Violation reason) const {
    std::size_t good = 0, bad = plan_.steps.size();
    while (bad - good > 1) {
      const std::size_t middle = good + (bad - good) / 2;
      const auto broken = violation(before_, measures_of(first(middle).solid), invariants_);
      (broken ? bad : good) = middle;
      if (broken) reason = *broken;
    }
    return {plan_.steps[bad - 1].feature, std::move(reason.code), std::move(reason.sentence)};
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
  Measures before_;
  std::vector<CarriedOut::Refused> undone_;
};

}  // namespace

CarriedOut carry_out(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                     const SegmentOptions& options, const Invariants& invariants) {
  return Guard(solid, segmentation, plan, options, invariants).run();
}

}  // namespace oriel
