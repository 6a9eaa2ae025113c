#include "interpret/score/score.h"

#include "interpret/score/match.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace oriel {

namespace {

double ratio(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::string percent(double share) { return std::isnan(share) ? "-" : fmt::format("{:.3f}", share); }

std::string class_line(const std::string& label, const ClassScore& counts) {
  return fmt::format("{:<12} {:>6} {:>6} {:>6} {:>10} {:>7} {:>6}\n", printable(label),
                     counts.true_positives, counts.false_positives, counts.false_negatives,
                     percent(counts.precision()), percent(counts.recall()), percent(counts.f1()));
}

/// All words of it printable.
std::string miss_line(const Miss& of) {
  const Miss miss = printable(of);
  if (miss.prediction_id.empty())
    return fmt::format("  {}: {} {} was not found\n", miss.building, miss.truth_label,
                       miss.truth_id);
  if (miss.truth_id.empty())
    return fmt::format("  {}: {} was called {}, but nothing is there\n", miss.building,
                       miss.prediction_id, miss.prediction_label);
  return fmt::format("  {}: {} {} was called {} ({}, IoU {:.2f})\n", miss.building,
                     miss.truth_label, miss.truth_id, miss.prediction_label, miss.prediction_id,
                     miss.iou);
}

std::string class_json(const std::string& label, const ClassScore& counts) {
  return fmt::format(R"({}:{{"tp":{},"fp":{},"fn":{},"precision":{},"recall":{},"f1":{}}})",
                     json_string(label), counts.true_positives, counts.false_positives,
                     counts.false_negatives, json_number(counts.precision()),
                     json_number(counts.recall()), json_number(counts.f1()));
}

std::string miss_json(const Miss& miss) {
  return fmt::format(
      R"({{"building":{},"truth_id":{},"truth":{},"prediction_id":{},"predicted":{},"iou":{}}})",
      json_string(miss.building), json_string(miss.truth_id), json_string(miss.truth_label),
      json_string(miss.prediction_id), json_string(miss.prediction_label), json_number(miss.iou));
}

void append(std::string& list, const std::string& element) {
  list += (list.empty() ? "" : ",") + element;
}

}  // namespace

Miss printable(const Miss& miss) {
  return {printable(miss.building),         printable(miss.truth_id),
          printable(miss.truth_label),      printable(miss.prediction_id),
          printable(miss.prediction_label), miss.iou};
}

bool is_left_out(const ExpectedObject& object) {
  return !object.has_faces || (object.label == "other" && object.subclass == "installation");
}

bool is_scored(const std::string& label, const ScoreOptions& options) {
  return std::ranges::find(options.not_scored, label) == options.not_scored.end();
}

ClassScore& ClassScore::operator+=(const ClassScore& other) {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  return *this;
}

double ClassScore::precision() const {
  return ratio(true_positives, true_positives + false_positives);
}

double ClassScore::recall() const {
  return ratio(true_positives, true_positives + false_negatives);
}

double ClassScore::f1() const {
  return ratio(2 * true_positives, 2 * true_positives + false_positives + false_negatives);
}

double Score::macro_f1() const {
  double sum = 0;
  std::size_t count = 0;
  for (const auto& [label, counts] : classes) {
    if (counts.true_positives + counts.false_negatives == 0) continue;
    sum += counts.f1();
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

std::map<std::string, Score> score_by_building(const std::vector<Prediction>& predictions,
                                               const std::vector<ExpectedObject>& truth,
                                               const ScoreOptions& options) {
  return score_by_building(match_objects(predictions, truth, options), options);
}

Score total(const std::map<std::string, Score>& buildings) {
  Score sum;
  for (const auto& [building, score] : buildings) {
    for (const auto& [label, counts] : score.classes) sum.classes[label] += counts;
    for (const auto& [labels, count] : score.confusion) sum.confusion[labels] += count;
    sum.misses.insert(sum.misses.end(), score.misses.begin(), score.misses.end());
    sum.neutral += score.neutral;
    sum.left_out.insert(sum.left_out.end(), score.left_out.begin(), score.left_out.end());
  }
  std::ranges::stable_sort(sum.misses, {}, [](const Miss& m) {
    return std::tie(m.building, m.truth_label, m.truth_id, m.prediction_label, m.prediction_id);
  });
  return sum;
}

Score score(const std::vector<Prediction>& predictions, const std::vector<ExpectedObject>& truth,
            const ScoreOptions& options) {
  return total(score_by_building(predictions, truth, options));
}

std::string to_text(const Score& score, std::size_t max_misses) {
  std::string text = fmt::format("{:<12} {:>6} {:>6} {:>6} {:>10} {:>7} {:>6}\n", "class", "tp",
                                 "fp", "fn", "precision", "recall", "F1");
  for (const auto& [label, counts] : score.classes) text += class_line(label, counts);
  text += fmt::format("macro-F1 {}\n", percent(score.macro_f1()));
  if (score.neutral > 0)
    text += fmt::format("{} on objects that are left out\n", counted(score.neutral, "prediction"));
  if (!score.confusion.empty()) text += "truth -> predicted\n";
  for (const auto& [labels, count] : score.confusion)
    text += fmt::format("  {:<12} -> {:<12} {:>6}\n", printable(labels.first),
                        printable(labels.second), count);
  const std::size_t shown = std::min(max_misses, score.misses.size());
  if (!score.misses.empty()) text += fmt::format("misses: {}\n", score.misses.size());
  for (std::size_t i = 0; i < shown; ++i) text += miss_line(score.misses[i]);
  if (shown < score.misses.size())
    text += fmt::format("  ... and {} more\n", score.misses.size() - shown);
  return text;
}

std::string to_json(const Score& score, const std::vector<std::string>& further) {
  std::string classes, confusion, misses;
  for (const auto& [label, counts] : score.classes) append(classes, class_json(label, counts));
  for (const auto& [labels, count] : score.confusion)
    append(confusion, fmt::format(R"({{"truth":{},"predicted":{},"count":{}}})",
                                  json_string(labels.first), json_string(labels.second), count));
  for (const Miss& miss : score.misses) append(misses, miss_json(miss));
  std::string more;
  for (const std::string& member : further) more += "," + member;
  return fmt::format(
      R"({{"classes":{{{}}},"macro_f1":{},"neutral":{},"confusion":[{}],"misses":[{}]{}}})",
      classes, json_number(score.macro_f1()), score.neutral, confusion, misses, more);
}

}  // namespace oriel
