#include "interpret/explain/explain.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Cells wider than this do not push the others aside.
constexpr std::size_t kWidestCell = 56;
/// So many names are printed of those that hold a label.
constexpr std::size_t kMostHolders = 5;

const char* mark_of(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unknown";
  return outcome == Outcome::holds ? "holds" : "fails";
}

const char* veto_mark_of(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unless ?";
  return outcome == Outcome::holds ? "vetoes" : "no veto";
}

void add(std::string& text, const std::string& more) {
  if (!text.empty() && !more.empty()) text += ", ";
  text += more;
}

void add_missing(std::string& text, const std::vector<std::string>& missing) {
  for (const std::string& attribute : missing) add(text, attribute + " is missing");
}

/// "nearest miss f12: a is 1.40 m, must be within 10 % of 2.10 m, differs by 33.3 %; sense is hole,
/// must be imprint".
void add_nearest(std::string& text, const std::string& nearest,
                 const std::vector<ConditionReport>& misses) {
  if (nearest.empty()) return;
  std::string all;
  for (const ConditionReport& miss : misses) {
    if (!all.empty()) all += "; ";
    all += miss.value.empty() ? miss.text : miss.value;
    add(all, miss.bound);
    add(all, miss.miss);
    add_missing(all, miss.missing);
  }
  add(text, fmt::format("nearest miss {}: {}", nearest, all));
}

void add_condition(const ConditionReport& report, const char* mark, std::size_t indent,
                   std::vector<ExplanationRow>& rows) {
  const std::string& found = report.value.empty() ? report.text : report.value;
  std::string bound = report.bound;
  add(bound, report.miss);
  add_missing(bound, report.missing);
  add_nearest(bound, report.nearest, report.nearest_misses);
  rows.push_back({indent, {mark, found, bound}, report.place});
  for (const ConditionReport& part : report.parts)
    add_condition(part, mark_of(part.outcome), indent + 2, rows);
}

std::string to_string(const RoundReport& round) {
  if (round.label.empty()) return "unknown";
  return fmt::format("{} {:.2f} by {}, margin {:.2f}", round.label, round.score, round.rule,
                     round.margin);
}

/// "+0.04"; nothing is added without a sign.
std::string signed_text(double shift) {
  return std::abs(shift) < 0.005 ? "0.00" : fmt::format("{:+.2f}", shift);
}

std::string evidence_mark(double shift) { return "evidence " + signed_text(shift); }

/// "5 of 6 alike are window"; who they are.
void add_company(const EvidenceReport& evidence, const std::string& label,
                 std::vector<ExplanationRow>& rows) {
  if (evidence.company == 0) return;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMostHolders, evidence.holders.size()); ++i)
    add(names, evidence.holders[i]);
  if (evidence.holders.size() > kMostHolders)
    names += fmt::format(" and {} more", evidence.holders.size() - kMostHolders);
  rows.push_back({4,
                  {evidence_mark(evidence.company_shift),
                   fmt::format("{} of {} {} are {}", evidence.holders.size(), evidence.company,
                               fmt::join(evidence.relations, " or "), label),
                   names},
                  evidence.place});
}

void add_evidence(const RuleReport& rule, std::vector<ExplanationRow>& rows) {
  if (!rule.evidence) return;
  add_company(*rule.evidence, rule.label, rows);
  for (const CountReport& count : rule.evidence->counts)
    rows.push_back(
        {4,
         {evidence_mark(count.shift),
          fmt::format("{} in the {}: {}", count.label, count.per, counted(count.others, "other")),
          fmt::format("typical {} ..{}", count.low,
                      count.high ? fmt::format(" {}", *count.high) : "")},
         count.place});
}

/// "; without evidence door 0.62 by door.on_ground", if that is another label.
std::string without_evidence(const Explanation& explanation) {
  if (!explanation.without_evidence) return "";
  const RoundReport& without = *explanation.without_evidence;
  if (without.label.empty()) return "; without evidence unknown";
  return fmt::format("; without evidence {} {:.2f} by {}", without.label, without.score,
                     without.rule);
}

void pad(std::string& text, std::size_t column) {
  text += std::string(text.size() < column ? column - text.size() : 1, ' ');
}

}  // namespace

std::string place_text(const Place& place) {
  return fmt::format("{}:{}:{}", place.file, place.line, place.column);
}

std::string score_text(double score, double other) {
  constexpr int kFewest = 2, kMost = 6;
  const auto text = [](double value, int decimals) {
    return fmt::format("{:.{}f}", value, decimals);
  };
  int decimals = kFewest;
  while (decimals < kMost && score != other && text(score, decimals) == text(other, decimals))
    ++decimals;
  return text(score, decimals);
}

std::string one_line(const ExplanationRow& row) {
  std::string found;
  for (std::size_t cell = 1; cell < row.cells.size(); ++cell) add(found, row.cells[cell]);
  if (row.cells[0] == mark_of(Outcome::holds)) return found;
  return found.empty() ? row.cells[0] : row.cells[0] + ": " + found;
}

ExplanationRow row_of(const MissReport& miss) {
  const ConditionReport& report = miss.condition;
  std::vector<ExplanationRow> rows;
  add_condition(report, miss.is_veto ? veto_mark_of(report.outcome) : mark_of(report.outcome), 0,
                rows);
  return rows.front();
}

std::string headline(const Explanation& explanation) {
  const Verdict& verdict = explanation.verdict;
  if (verdict.label.empty()) {
    std::string text = explanation.feature + " -> unknown";
    if (!explanation.best) return text + "   no rule for a label holds";
    const RuleReport& best = explanation.rules[*explanation.best];
    return text +
           fmt::format("   best candidate: {} {} (< min_score {})", best.label,
                       score_text(best.total(), explanation.min_score),
                       score_text(explanation.min_score, best.total())) +
           without_evidence(explanation);
  }
  std::string text = fmt::format("{} -> {} {:.2f} by {}, margin {:.2f}", explanation.feature,
                                 verdict.label, verdict.score, verdict.rule, verdict.margin);
  if (!verdict.runner_up.empty()) text += ", then " + verdict.runner_up.text();
  return text + without_evidence(explanation);
}

std::vector<ExplanationRow> rows_of(const RuleReport& rule) {
  std::vector<ExplanationRow> rows;
  std::string outcome = mark_of(rule.outcome);
  if (rule.outcome == Outcome::holds && !rule.is_predicate)
    outcome += fmt::format(", score {:.2f}", rule.score);
  if (rule.evidence) outcome += fmt::format(", evidence {}", signed_text(rule.evidence->shift));
  rows.push_back({2, {rule.id, outcome, rule.label}, rule.place});
  for (const ConditionReport& report : rule.require)
    add_condition(report, mark_of(report.outcome), 4, rows);
  for (const ConditionReport& report : rule.unless)
    add_condition(report, veto_mark_of(report.outcome), 4, rows);
  if (rule.outcome != Outcome::holds) return rows;
  for (const TermReport& term : rule.terms) {
    const std::string judged = term.judged ? fmt::format("{:.2f}", *term.judged) : "-";
    std::string bound = term.bound;
    add_missing(bound, term.missing);
    add_nearest(bound, term.nearest, term.nearest_misses);
    rows.push_back(
        {4, {fmt::format("{} x{:g}", judged, term.weight), term.value, bound}, term.place});
  }
  add_evidence(rule, rows);
  return rows;
}

namespace {

/// "corrected to door by ada (corrections.jsonl:3): it has a handle; the rules say:"
std::string correction_clause(const CorrectedLabel& corrected, const std::string& place) {
  std::string text = "corrected to " + corrected.label;
  if (!corrected.by.empty()) text += " by " + corrected.by;
  if (!place.empty()) text += fmt::format(" ({})", place);
  if (!corrected.why.empty()) text += ": " + corrected.why;
  return text + "; the rules say:";
}

}  // namespace

std::string correction_line(const Explanation& explanation) {
  if (!explanation.corrected) return {};
  const Place& place = explanation.corrected->place;
  return printable(correction_clause(*explanation.corrected,
                                     fmt::format("{}:{}", place.file, place.line))) +
         "\n";
}

std::string reason(const Explanation& explanation) {
  const Verdict& verdict = explanation.verdict;
  // Without the file: the reason goes into outputs, which do not depend on where that lies.
  const std::string corrected =
      explanation.corrected ? correction_clause(*explanation.corrected, "") + " " : "";
  if (verdict.label.empty())
    return corrected + headline(explanation).substr(explanation.feature.size() + 4);
  std::string text =
      fmt::format("{}{} {:.2f} by {}", corrected, verdict.label, verdict.score, verdict.rule);
  const auto rule = std::ranges::find(explanation.rules, verdict.rule.text(), &RuleReport::id);
  if (rule == explanation.rules.end()) return text;
  const auto rows = rows_of(*rule);
  bool is_first = true;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (rows[i].indent > rows[1].indent) continue;
    text += is_first ? ": " : "; ";
    is_first = false;
    text += one_line(rows[i]);
  }
  return text + without_evidence(explanation);
}

std::string flip_line(const FlipSearch& search) {
  if (search.nearest) {
    const Flip& flip = *search.nearest;
    const std::string becomes =
        flip.label.empty() ? "unknown"
                           : fmt::format("{} {:.2f} by {}", flip.label, flip.score, flip.rule);
    return fmt::format("nearest flip: {} {} -> {}: {}", flip.param, flip.from_text, flip.to_text,
                       becomes);
  }
  std::string text = "nearest flip: ";
  if (search.params == 0)
    text += "no param has a range to be moved in";
  else
    text += fmt::format("no param ({}) flips the label within its range", search.params);
  if (search.reach < 1) text += fmt::format(", as far as {:.2g} of it was searched", search.reach);
  if (search.params > 0 && !search.without_range.empty())
    text += fmt::format("; without a range: {}", fmt::join(search.without_range, ", "));
  return text;
}

std::string table_of(const std::vector<ExplanationRow>& lines) {
  std::array<std::size_t, 3> columns{};
  std::size_t start = 0;
  for (std::size_t cell = 0; cell < columns.size(); ++cell) {
    std::size_t width = 0;
    for (const ExplanationRow& line : lines)
      width = std::max(
          width, std::min(kWidestCell, line.cells[cell].size() + (cell == 0 ? line.indent : 0)));
    start += width + 2;
    columns[cell] = start;
  }
  std::string text;
  for (const ExplanationRow& line : lines) {
    std::string row(line.indent, ' ');
    for (std::size_t cell = 0; cell < columns.size(); ++cell) {
      row += line.cells[cell];
      pad(row, columns[cell]);
    }
    text += printable(row + place_text(line.place)) + "\n";
  }
  return text;
}

std::string to_text(const Explanation& explanation) {
  std::vector<ExplanationRow> lines;
  for (const RuleReport& rule : explanation.rules)
    for (ExplanationRow& row : rows_of(rule)) lines.push_back(std::move(row));
  std::string text = correction_line(explanation) + printable(headline(explanation)) + "\n";
  for (std::size_t i = 0; i < explanation.rounds.size(); ++i)
    text += fmt::format("  round {}: {}\n", i + 1, printable(to_string(explanation.rounds[i])));
  text += table_of(lines);
  if (explanation.flip) text += "  " + printable(flip_line(*explanation.flip)) + "\n";
  return text;
}

}  // namespace oriel
