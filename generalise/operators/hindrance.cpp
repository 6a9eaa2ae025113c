#include "generalise/operators/hindrance.h"

#include "generalise/operators/facade.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace oriel::detail {

namespace {

constexpr int kEighths = 8;
/// A gap is no smaller: attach takes no less.
constexpr double kLeastGap_m = 0.001;

/// The greatest of some values from 0 to `most` with which something acts, if it does with 0; with
/// `most` it does not.
std::optional<int> greatest(int most, const std::function<bool(int)>& acts) {
  if (most < 1 || !acts(0)) return std::nullopt;
  int good = 0, bad = most;
  while (bad - good > 1) {
    const int middle = good + (bad - good) / 2;
    (acts(middle) ? good : bad) = middle;
  }
  return good;
}

class HindranceFinder {
 public:
  HindranceFinder(const Operator& its, const Redrawing& task) : its_(its), task_(task) {}

  Hindrance run() {
    const double gap_m = task_.gap_m();
    add_length("gap", std::min(kLeastGap_m, gap_m), gap_m);
    if (its_.name == "symbolise") add_length("to", task_.to_m() / kEighths, task_.to_m());
    if (its_.name == "typify") add_ratio();
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
    Extents all = extents_of(*host, task_.segmentation, task_.feature());
    for (std::size_t i = 1; i < task_.steps.size(); ++i)
      all = united(all, extents_of(*host, task_.segmentation, task_.feature(i)));
    out_.beside = FacadeRoom(task_.solid, task_.segmentation, *host).beside(all, task_.gap_m());
  }

  const Operator& its_;
  const Redrawing& task_;
  Hindrance out_;
};

}  // namespace

Hindrance hindrance_of(const Operator& its, const Redrawing& task) {
  return HindranceFinder(its, task).run();
}

}  // namespace oriel::detail
