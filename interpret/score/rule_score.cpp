#include "interpret/score/rule_score.h"

#include "interpret/pack/pack.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

constexpr const char* kNoRule = "-";
constexpr const char* kNoObject = "-";

using FeatureKey = std::pair<std::string, std::string>;

std::string truth_of(const Miss& miss) {
  return miss.truth_label.empty() ? kNoObject : miss.truth_label;
}

std::map<FeatureKey, const Miss*> mistakes_of(const Score& score) {
  std::map<FeatureKey, const Miss*> mistakes;
  for (const Miss& miss : score.misses)
    if (!miss.prediction_id.empty()) mistakes[{miss.building, miss.prediction_id}] = &miss;
  return mistakes;
}

/// `miss` is null where the prediction is right.
void add_contest(const Prediction& prediction, const Miss* miss, RuleScore& rule) {
  if (prediction.runner_up.empty()) return;
  RuleScore::Contest& contest = rule.contests[prediction.runner_up];
  ++contest.count;
  if (miss == nullptr) return;
  ++contest.wrong;
  if (miss->truth_label == prediction.runner_up) ++contest.second_is_right;
}

void add_mistake(const Miss& miss, RuleScore& rule) {
  ++rule.wrong;
  ++rule.taken_for[truth_of(miss)];
  rule.mistakes.push_back(miss);
}

std::string rule_line(const std::string& id, const RuleScore& rule, std::size_t width) {
  const double precision = rule.precision();
  return fmt::format("{:<{}} {:<10} {:>7} {:>6} {:>6} {:>9} {:>10}\n", printable(id), width,
                     printable(rule.label), rule.decided(), rule.right, rule.wrong, rule.left_out,
                     std::isnan(precision) ? "-" : fmt::format("{:.3f}", precision));
}

/// "    wrong: 3 door, 12 nothing".
std::string wrong_line(const RuleScore& rule) {
  std::string text;
  for (const auto& [label, count] : rule.taken_for)
    text += fmt::format("{}{} {}", text.empty() ? "    wrong: " : ", ", count,
                        label == kNoObject ? "nothing there" : printable(label));
  return text.empty() ? text : text + "\n";
}

/// "    contested: 14 by window (3 wrong, 2 of them a window)".
std::string contest_line(const RuleScore& rule) {
  std::string text;
  for (const auto& [label, contest] : rule.contests) {
    text += fmt::format("{}{} by {}", text.empty() ? "    contested: " : ", ", contest.count,
                        printable(label));
    if (contest.wrong == 0) continue;
    text += fmt::format(" ({} wrong, {} of them a {})", contest.wrong, contest.second_is_right,
                        printable(label));
  }
  return text.empty() ? text : text + "\n";
}

std::string mistake_line(const std::string& id, const Miss& of) {
  const Miss miss = printable(of);
  const std::string where = fmt::format("  {} {}: {} was called {}", printable(id), miss.building,
                                        miss.prediction_id, miss.prediction_label);
  if (miss.truth_id.empty()) return where + ", but nothing is there\n";
  return fmt::format("{}, is {} {} (IoU {:.2f})\n", where, miss.truth_label, miss.truth_id,
                     miss.iou);
}

/// "decided nothing: bay.by_shape, vent.low", as many to a line as fit.
std::string idle_lines(const std::map<std::string, RuleScore>& rules) {
  constexpr std::size_t kWidth = 100;
  std::string text, line = "decided nothing:";
  for (const auto& [id, rule] : rules) {
    if (rule.decided() > 0) continue;
    if (line.size() + id.size() + 2 > kWidth) {
      text += line + "\n";
      line = "   ";
    }
    line += " " + printable(id) + ",";
  }
  if (!line.ends_with(',')) return {};
  line.back() = '\n';
  return text + line;
}

/// How many mistakes of each rule are shown, at least one, so that all together are no more than
/// `most` and no rule takes the place of the others.
std::size_t most_of_each(const std::map<std::string, RuleScore>& rules, std::size_t most) {
  std::size_t each = 1;
  const auto shown = [&](std::size_t of_each) {
    std::size_t sum = 0;
    for (const auto& [id, rule] : rules) sum += std::min(of_each, rule.mistakes.size());
    return sum;
  };
  while (shown(each + 1) <= most && shown(each + 1) > shown(each)) ++each;
  return each;
}

void append_to(std::string& list, const std::string& element) {
  list += (list.empty() ? "" : ",") + element;
}

std::string mistake_json(const Miss& miss) {
  return fmt::format(R"({{"building":{},"prediction_id":{},"truth_id":{},"truth":{},"iou":{}}})",
                     json_string(miss.building), json_string(miss.prediction_id),
                     json_string(miss.truth_id), json_string(miss.truth_label),
                     json_number(miss.iou));
}

std::string rule_json(const std::string& id, const RuleScore& rule) {
  std::string taken, contests, mistakes;
  for (const auto& [label, count] : rule.taken_for)
    append_to(taken, fmt::format("{}:{}", json_string(label), count));
  for (const auto& [label, contest] : rule.contests)
    append_to(contests, fmt::format(R"({}:{{"count":{},"wrong":{},"second_is_right":{}}})",
                                    json_string(label), contest.count, contest.wrong,
                                    contest.second_is_right));
  for (const Miss& miss : rule.mistakes) append_to(mistakes, mistake_json(miss));
  return fmt::format(
      R"({}:{{"label":{},"decided":{},"right":{},"wrong":{},"left_out":{},"precision":{},)"
      R"("taken_for":{{{}}},"contests":{{{}}},"mistakes":[{}]}})",
      json_string(id), json_string(rule.label), rule.decided(), rule.right, rule.wrong,
      rule.left_out, json_number(rule.precision()), taken, contests, mistakes);
}

}  // namespace

double RuleScore::precision() const {
  if (right + wrong == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(right) / static_cast<double>(right + wrong);
}

std::map<std::string, RuleScore> score_by_rule(const std::vector<Prediction>& predictions,
                                               const Score& score) {
  const auto mistakes = mistakes_of(score);
  const std::set<FeatureKey> left_out(score.left_out.begin(), score.left_out.end());
  std::map<std::string, RuleScore> by_rule;
  for (const Prediction& prediction : predictions) {
    if (prediction.label.empty()) continue;
    RuleScore& rule = by_rule[prediction.rule.empty() ? kNoRule : prediction.rule];
    rule.label = prediction.rule.empty() ? kNoRule : prediction.label;
    const FeatureKey key(prediction.building, prediction.id);
    if (left_out.contains(key)) {
      ++rule.left_out;
      continue;
    }
    const auto found = mistakes.find(key);
    const Miss* miss = found == mistakes.end() ? nullptr : found->second;
    if (miss == nullptr)
      ++rule.right;
    else
      add_mistake(*miss, rule);
    add_contest(prediction, miss, rule);
  }
  for (auto& [id, rule] : by_rule)
    std::ranges::stable_sort(rule.mistakes, {}, [](const Miss& miss) {
      return std::pair(miss.building, miss.prediction_id);
    });
  return by_rule;
}

bool add_rules_without_decision(const RuleBase& base, std::map<std::string, RuleScore>& by_rule) {
  std::map<std::string, std::string> labels;
  for (const rules::Rule& rule : base.pack().rules)
    if (!base.pack().classes[static_cast<std::size_t>(rule.label)].is_abstract)
      labels[rule.id] = rule.name_of_label;
  for (const auto& [id, rule] : by_rule)
    if (const auto known = labels.find(id);
        id != kNoRule && (known == labels.end() || known->second != rule.label))
      return false;
  for (const auto& [id, label] : labels) by_rule.try_emplace(id).first->second.label = label;
  return true;
}

std::string to_text(const std::map<std::string, RuleScore>& rules, std::size_t max_mistakes) {
  std::size_t width = 4, mistakes = 0;
  for (const auto& [id, rule] : rules) width = std::max(width, id.size());
  std::string text = fmt::format("{:<{}} {:<10} {:>7} {:>6} {:>6} {:>9} {:>10}\n", "rule", width,
                                 "label", "decided", "right", "wrong", "left out", "precision");
  for (const auto& [id, rule] : rules) {
    mistakes += rule.mistakes.size();
    if (rule.decided() > 0)
      text += rule_line(id, rule, width) + wrong_line(rule) + contest_line(rule);
  }
  text += idle_lines(rules);
  if (mistakes == 0) return text;
  text += fmt::format("mistakes by rule: {}\n", mistakes);
  const std::size_t most = most_of_each(rules, max_mistakes);
  for (const auto& [id, rule] : rules) {
    const std::size_t shown = std::min(most, rule.mistakes.size());
    for (std::size_t i = 0; i < shown; ++i) text += mistake_line(id, rule.mistakes[i]);
    if (const std::size_t more = rule.mistakes.size() - shown; more > 0)
      text += fmt::format("  {} ... and {} more\n", printable(id), more);
  }
  return text;
}

std::string rules_json(const std::map<std::string, RuleScore>& rules) {
  std::string text;
  for (const auto& [id, rule] : rules) append_to(text, rule_json(id, rule));
  return fmt::format(R"("rules":{{{}}})", text);
}

}  // namespace oriel
