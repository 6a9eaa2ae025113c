#include "interpret/explain.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace oriel {

namespace {

/// One line: mark, what was found, what was asked for, where.
struct Line {
  std::size_t indent = 0;
  std::array<std::string, 3> cells;
  Place place;
};

/// Cells wider than this do not push the others aside.
constexpr std::size_t kWidestCell = 48;

std::string to_string(const Place& place) {
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

const char* mark_of(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unknown";
  return outcome == Outcome::holds ? "holds" : "fails";
}

const char* veto_mark_of(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unless ?";
  return outcome == Outcome::holds ? "vetoes" : "no veto";
}

std::string joined(const std::string& bound, const std::string& miss,
                   const std::vector<std::string>& missing) {
  std::string text = bound;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  if (!miss.empty()) add(miss);
  for (const std::string& attribute : missing) add(attribute + " is missing");
  return text;
}

void add_condition(const ConditionReport& report, const char* mark, std::size_t indent,
                   std::vector<Line>& lines) {
  const std::string& found = report.value.empty() ? report.text : report.value;
  lines.push_back(
      {indent, {mark, found, joined(report.bound, report.miss, report.missing)}, report.place});
  for (const ConditionReport& part : report.parts)
    add_condition(part, mark_of(part.outcome), indent + 2, lines);
}

void add_rule(const RuleReport& rule, std::vector<Line>& lines) {
  std::string outcome = mark_of(rule.outcome);
  if (rule.outcome == Outcome::holds && !rule.is_predicate)
    outcome += fmt::format(", score {:.2f}", rule.score);
  lines.push_back({2, {rule.id, outcome, rule.label}, rule.place});
  for (const ConditionReport& report : rule.require)
    add_condition(report, mark_of(report.outcome), 4, lines);
  for (const ConditionReport& report : rule.unless)
    add_condition(report, veto_mark_of(report.outcome), 4, lines);
  if (rule.outcome != Outcome::holds) return;
  for (const TermReport& term : rule.terms) {
    const std::string judged = term.judged ? fmt::format("{:.2f}", *term.judged) : "-";
    lines.push_back({4,
                     {fmt::format("{} x{:g}", judged, term.weight), term.value,
                      joined(term.bound, "", term.missing)},
                     term.place});
  }
}

std::string headline(const Explanation& explanation) {
  const Verdict& verdict = explanation.verdict;
  if (verdict.label.empty()) {
    std::string text = explanation.feature + " -> unknown";
    if (!explanation.best) return text + "   no rule for a label holds";
    const RuleReport& best = explanation.rules[*explanation.best];
    return text + fmt::format("   best candidate: {} {:.2f} (< min_score {:.2f})", best.label,
                              best.score, explanation.min_score);
  }
  std::string text = fmt::format("{} -> {} {:.2f} by {}, margin {:.2f}", explanation.feature,
                                 verdict.label, verdict.score, verdict.rule, verdict.margin);
  if (!verdict.runner_up.empty()) text += ", then " + verdict.runner_up;
  return text;
}

std::string to_string(const RoundReport& round) {
  if (round.label.empty()) return "unknown";
  return fmt::format("{} {:.2f} by {}, margin {:.2f}", round.label, round.score, round.rule,
                     round.margin);
}

void pad(std::string& text, std::size_t column) {
  text += std::string(text.size() < column ? column - text.size() : 1, ' ');
}

}  // namespace

std::string to_text(const Explanation& explanation) {
  std::vector<Line> lines;
  for (const RuleReport& rule : explanation.rules) add_rule(rule, lines);
  std::array<std::size_t, 3> columns{};
  std::size_t start = 0;
  for (std::size_t cell = 0; cell < columns.size(); ++cell) {
    std::size_t width = 0;
    for (const Line& line : lines)
      width = std::max(
          width, std::min(kWidestCell, line.cells[cell].size() + (cell == 0 ? line.indent : 0)));
    start += width + 2;
    columns[cell] = start;
  }
  std::string text = headline(explanation) + "\n";
  for (std::size_t i = 0; i < explanation.rounds.size(); ++i)
    text += fmt::format("  round {}: {}\n", i + 1, to_string(explanation.rounds[i]));
  for (const Line& line : lines) {
    std::string row(line.indent, ' ');
    for (std::size_t cell = 0; cell < columns.size(); ++cell) {
      row += line.cells[cell];
      pad(row, columns[cell]);
    }
    text += row + to_string(line.place) + "\n";
  }
  return text;
}

}  // namespace oriel
