#include "interpret/score/score.h"
#include "interpret/yaml/json_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::json_number;
using rules::json_string;

std::string percent(double share) { return std::isnan(share) ? "-" : fmt::format("{:.3f}", share); }

std::string class_line(const std::string& label, const ClassScore& counts) {
  return fmt::format("{:<12} {:>6} {:>6} {:>6} {:>10} {:>7} {:>6}\n", label, counts.true_positives,
                     counts.false_positives, counts.false_negatives, percent(counts.precision()),
                     percent(counts.recall()), percent(counts.f1()));
}

std::string miss_line(const Miss& miss) {
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

std::string to_text(const Score& score, std::size_t max_misses) {
  std::string text = fmt::format("{:<12} {:>6} {:>6} {:>6} {:>10} {:>7} {:>6}\n", "class", "tp",
                                 "fp", "fn", "precision", "recall", "F1");
  for (const auto& [label, counts] : score.classes) text += class_line(label, counts);
  text += fmt::format("macro-F1 {}\n", percent(score.macro_f1()));
  if (score.neutral > 0)
    text += fmt::format("{} predictions on objects that are left out\n", score.neutral);
  if (!score.confusion.empty()) text += "truth -> predicted\n";
  for (const auto& [labels, count] : score.confusion)
    text += fmt::format("  {:<12} -> {:<12} {:>6}\n", labels.first, labels.second, count);
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
