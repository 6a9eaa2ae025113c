#include "interpret/score/score_spread.h"

#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <fmt/format.h>

namespace oriel {

namespace {

/// The middle 95 %.
constexpr double kTail = 0.025;

/// What a building has, the predictions with the best scores first.
struct BuildingRecords {
  std::vector<Prediction> predictions;
  std::vector<ExpectedObject> truth;

  [[nodiscard]] Score at_least(double threshold, const ScoreOptions& options) const {
    const auto end =
        std::ranges::find_if(predictions, [&](const Prediction& p) { return p.score < threshold; });
    return score({predictions.begin(), end}, truth, options);
  }
};

}  // namespace

ConfidenceInterval middle_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none};
  }
  std::ranges::sort(values);
  const auto last = static_cast<double>(values.size() - 1);
  return {values[static_cast<std::size_t>(std::floor(kTail * last))],
          values[static_cast<std::size_t>(std::ceil((1 - kTail) * last))]};
}

std::vector<CurvePoint> precision_recall_curve(const std::vector<Prediction>& predictions,
                                               const std::vector<ExpectedObject>& truth,
                                               const ScoreOptions& options) {
  std::map<std::string, BuildingRecords> buildings;
  for (const ExpectedObject& object : truth) buildings[object.building].truth.push_back(object);
  // Where the threshold passes a prediction, its building is matched anew.
  std::map<double, std::set<std::string>, std::greater<>> steps;
  for (const Prediction& prediction : predictions) {
    if (prediction.label.empty()) continue;
    buildings[prediction.building].predictions.push_back(prediction);
    steps[prediction.score].insert(prediction.building);
  }
  std::map<std::string, Score> scores;
  constexpr double above_all = std::numeric_limits<double>::infinity();
  for (auto& [building, content] : buildings) {
    std::ranges::stable_sort(content.predictions, std::greater<>(), &Prediction::score);
    scores[building] = content.at_least(above_all, options);
  }
  std::vector<CurvePoint> curve;
  for (const auto& [threshold, changed] : steps) {
    for (const std::string& building : changed)
      scores[building] = buildings[building].at_least(threshold, options);
    std::map<std::string, ClassScore> classes;
    for (const auto& [building, score] : scores)
      for (const auto& [label, counts] : score.classes) classes[label] += counts;
    for (const auto& [label, counts] : classes) curve.push_back({threshold, label, counts});
  }
  return curve;
}

Intervals bootstrap(const std::map<std::string, Score>& buildings, std::size_t samples) {
  std::vector<const Score*> all;
  std::map<std::string, std::vector<double>> f1;
  for (const auto& [building, score] : buildings) {
    all.push_back(&score);
    for (const auto& [label, counts] : score.classes) f1[label];
  }
  std::vector<double> macro_f1;
  BuildingDraws draws(std::max<std::size_t>(all.size(), 1));
  for (std::size_t sample = 0; sample < samples && !all.empty(); ++sample) {
    Score drawn;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (const auto& [label, counts] : all[draws.next()]->classes) drawn.classes[label] += counts;
    for (const auto& [label, counts] : drawn.classes) f1[label].push_back(counts.f1());
    macro_f1.push_back(drawn.macro_f1());
  }
  Intervals intervals;
  intervals.samples = samples;
  intervals.macro_f1 = middle_of(std::move(macro_f1));
  for (auto& [label, values] : f1) intervals.f1[label] = middle_of(std::move(values));
  return intervals;
}

std::string to_text(const Intervals& intervals) {
  std::string text =
      fmt::format("95 % of {} samples of the buildings have F1\n", intervals.samples);
  for (const auto& [label, interval] : intervals.f1)
    text +=
        fmt::format("  {:<12} {:.3f} to {:.3f}\n", printable(label), interval.low, interval.high);
  return text + fmt::format("  {:<12} {:.3f} to {:.3f}\n", "macro-F1", intervals.macro_f1.low,
                            intervals.macro_f1.high);
}

std::string interval_json(const ConfidenceInterval& interval) {
  return fmt::format("[{},{}]", json_number(interval.low), json_number(interval.high));
}

std::string intervals_json(const Intervals& intervals) {
  std::string classes;
  for (const auto& [label, interval] : intervals.f1)
    classes += fmt::format("{}{}:{}", classes.empty() ? "" : ",", json_string(label),
                           interval_json(interval));
  return fmt::format(R"("intervals":{{"samples":{},"f1":{{{}}},"macro_f1":{}}})", intervals.samples,
                     classes, interval_json(intervals.macro_f1));
}

}  // namespace oriel
