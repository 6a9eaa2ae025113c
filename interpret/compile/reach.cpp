#include "interpret/compile/reach.h"

#include "interpret/explain/constraints.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

class ReachChecker {
 public:
  ReachChecker(const Pack& pack, Findings& findings) : pack_(&pack), findings_(&findings) {
    for (const Rule& rule : pack.rules) constraints_.emplace_back(pack, rule.require);
    for (std::size_t step = 0; step < pack.steps.size(); ++step) {
      for (const int rule : pack.steps[step].rules) step_of_[oriel::at(rule)] = step;
    }
  }

  void run() {
    for (std::size_t i = 0; i < pack_->rules.size(); ++i) {
      if (!pack_->source.is_in_first(pack_->rules[i].span.begin)) continue;
      if (!report_never(i)) report_shadowed(i);
    }
  }

 private:
  [[nodiscard]] const Expr& at(ExprId id) const { return pack_->code[oriel::at(id)]; }
  [[nodiscard]] std::string text_of(ExprId id) const {
    return std::string(pack_->source.text_of(at(id).span));
  }

  bool report_never(std::size_t i) {
    const Rule& rule = pack_->rules[i];
    if (const auto pair = constraints_[i].contradiction()) {
      const bool is_one = pair->first == pair->second;
      const std::string what = is_one ? fmt::format("'{}' never holds", text_of(pair->first))
                                      : fmt::format("'{}' and '{}' exclude each other",
                                                    text_of(pair->first), text_of(pair->second));
      warn_in(rule, at(pair->second).span,
              fmt::format("the rule '{}' can never hold: {}", rule.id, what));
      return true;
    }
    for (const ExprId veto : rule.unless) {
      if (!constraints_[i].imply(veto)) continue;
      warn_in(rule, at(veto).span,
              fmt::format("the rule '{}' can never hold: '{}' follows from what it requires and "
                          "always vetoes",
                          rule.id, text_of(veto)));
      return true;
    }
    return false;
  }

  /// At the condition, or at the rule if the condition stands in a pack beneath.
  void warn_in(const Rule& rule, SourceSpan span, std::string sentence) {
    const bool is_own = pack_->source.is_in_first(span.begin);
    findings_->warning(Code::R254, is_own ? span : rule.span, std::move(sentence));
  }

  void report_shadowed(std::size_t i) {
    const Rule& rule = pack_->rules[i];
    for (std::size_t j = 0; j < pack_->rules.size(); ++j) {
      const Rule& other = pack_->rules[j];
      if (i == j || !comes_first(j, i) || !holds_whenever(j, i)) continue;
      const bool is_predicate = pack_->classes[oriel::at(rule.label)].is_abstract;
      const Place place = pack_->source.place(other.span.begin);
      findings_->warning(Code::R255, rule.span,
                         fmt::format("the rule '{}' {}: whenever it holds, so does '{}' ({}:{}:{})",
                                     rule.id, is_predicate ? "adds nothing" : "never decides",
                                     other.id, place.file, place.line, place.column));
      return;
    }
  }

  /// True if rule j, where it holds, takes what rule i could decide. Its score must be 1.
  [[nodiscard]] bool comes_first(std::size_t j, std::size_t i) const {
    const Rule& first = pack_->rules[j];
    const Rule& second = pack_->rules[i];
    if (pack_->classes[oriel::at(second.label)].is_abstract)
      return first.label == second.label && (!holds_whenever(i, j) || j < i);
    if (pack_->classes[oriel::at(first.label)].is_abstract || !first.score.empty()) return false;
    const bool is_refining =
        first.label != second.label && is_within(pack_->classes, second.label, first.label);
    if (is_refining) return false;
    if (step_of_[oriel::at(static_cast<int>(j))] != step_of_[oriel::at(static_cast<int>(i))])
      return step_of_[j] < step_of_[i] && first.label != second.label;
    if (first.priority != second.priority) return first.priority > second.priority;
    // Evidence may turn what scores say.
    if (pack_->decide.evidence.is_written() && first.label != second.label) return false;
    return first.id < second.id;
  }

  /// True if rule j surely holds for every feature for which rule i does.
  [[nodiscard]] bool holds_whenever(std::size_t j, std::size_t i) const {
    const Rule& other = pack_->rules[j];
    const Rule& rule = pack_->rules[i];
    const bool is_required = std::ranges::all_of(
        other.require, [&](ExprId condition) { return constraints_[i].imply(condition); });
    return is_required && std::ranges::all_of(other.unless, [&](ExprId veto) {
             return std::ranges::any_of(rule.unless,
                                        [&](ExprId mine) { return is_same(*pack_, veto, mine); });
           });
  }

  const Pack* pack_;
  Findings* findings_;
  std::vector<Constraints> constraints_;
  std::vector<std::size_t> step_of_ = std::vector<std::size_t>(pack_->rules.size(), 0);
};

/// True if every feature that `second` is for is one that `first` is for.
bool covers_target(const Pack& pack, const GeneraliseEntry& first, const GeneraliseEntry& second) {
  if (first.group >= 0) return first.group == second.group;
  if (first.target == kNoClass) return true;
  if (second.group >= 0) {
    const ClassId of = pack.groups[oriel::at(second.group)].of;
    return is_within(pack.classes, of, first.target);
  }
  return is_within(pack.classes, second.target, first.target);
}

std::string scale_text(double from, double to) {
  if (to > 1e9) return fmt::format("1:{} ..", from);
  return fmt::format("1:{} .. 1:{}", from, to);
}

/// What the entry `second` leaves to be said of it, `first` standing before it without a condition.
bool report_overlap(const Pack& pack, const GeneraliseEntry& first, const GeneraliseEntry& second,
                    Findings& findings) {
  if (first.when != kNoExpr || first.id == second.id || !covers_target(pack, first, second))
    return false;
  const double from = std::max(first.scale_from, second.scale_from);
  const double to = std::min(first.scale_to, second.scale_to);
  const Place place = pack.source.place(first.span.begin);
  const std::string where = fmt::format("{}:{}:{}", place.file, place.line, place.column);
  if (from == second.scale_from && to == second.scale_to) {
    findings.warning(
        Code::R255, second.span,
        fmt::format("the entry '{}' never decides: '{}' ({}) comes before it, without a condition",
                    second.id, first.id, where));
    return true;
  }
  if (from >= to || first.operation == second.operation) return false;
  findings.warning(Code::R256, second.span,
                   fmt::format("at {} '{}' ({}) decides and '{}' does not: separate their scales, "
                               "or give the first one a condition",
                               scale_text(from, to), first.id, where, second.id));
  return true;
}

}  // namespace

void check_entries(const Pack& pack, Findings& findings) {
  for (std::size_t i = 0; i < pack.entries.size(); ++i) {
    const GeneraliseEntry& second = pack.entries[i];
    const bool is_refused = second.id.empty() || second.scale_from == 0;
    if (is_refused || !pack.source.is_in_first(second.span.begin)) continue;
    for (std::size_t j = 0; j < i; ++j)
      if (report_overlap(pack, pack.entries[j], second, findings)) break;
  }
}

void check_reach(const Pack& pack, Findings& findings) { ReachChecker(pack, findings).run(); }

}  // namespace oriel::rules
