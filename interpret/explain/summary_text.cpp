#include "interpret/explain/explain.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// So many rows of the winner and of the nearest miss are shown, if there are more one less.
constexpr std::size_t kMostShownFindings = 7;
constexpr std::size_t kMostMisses = 4;
/// Of score_text().
constexpr double kLeastShown = 0.000001;
/// Texts wider than this do not push the places aside.
constexpr std::size_t kWidestText = 76;

struct SummaryLine {
  std::string title;
  std::string text;
  /// Without a line number: none.
  Place place;
};

const RuleReport* winner_of(const Explanation& explanation) {
  const auto rule =
      std::ranges::find(explanation.rules, explanation.verdict.rule.text(), &RuleReport::id);
  return rule == explanation.rules.end() ? nullptr : &*rule;
}

bool precedes(const RuleReport& p, const RuleReport& q) {
  return p.priority != q.priority ? p.priority > q.priority : p.total() > q.total();
}

/// The best rule of the label that came second.
const RuleReport* runner_up_of(const Explanation& explanation) {
  const std::string& label = explanation.verdict.runner_up.text();
  const RuleReport* best = nullptr;
  for (const RuleReport& rule : explanation.rules) {
    if (label.empty() || rule.label != label || rule.outcome != Outcome::holds) continue;
    if (best == nullptr || precedes(rule, *best)) best = &rule;
  }
  return best;
}

/// ", ahead of window by 0.10", or why it came second whatever its score.
std::string second_clause(const Explanation& explanation, const RuleReport& second) {
  const RuleReport* winner = winner_of(explanation);
  const double margin = explanation.verdict.margin;
  if (second.total() < explanation.min_score)
    return fmt::format(", ahead of {}, whose score {} is below the minimum of {}", second.label,
                       score_text(second.total(), explanation.min_score),
                       score_text(explanation.min_score, second.total()));
  if (winner != nullptr && winner->priority != second.priority)
    return fmt::format(", ahead of {}, whose priority {} is below {}", second.label,
                       second.priority, winner->priority);
  if (margin == 0)
    return fmt::format(", tied with {}; of equal scores the rule whose id sorts first wins",
                       second.label);
  return fmt::format(", ahead of {} by {}", second.label,
                     margin < kLeastShown ? "less than 0.000001" : score_text(margin, 0));
}

std::string without_evidence_clause(const Explanation& explanation) {
  if (!explanation.without_evidence) return "";
  const RoundReport& without = *explanation.without_evidence;
  return without.label.empty() ? "; without evidence it would have none"
                               : fmt::format("; without evidence it would be {} {:.2f}",
                                             without.label, without.score);
}

/// "chimney 1 of roof slope north (f11yv1hbtweapa)".
std::string subject_text(const Explanation& explanation) {
  return explanation.name.empty() ? explanation.feature
                                  : fmt::format("{} ({})", explanation.name, explanation.feature);
}

std::string sentence_of_label(const Explanation& explanation) {
  const Verdict& verdict = explanation.verdict;
  std::string text =
      fmt::format("{} is labelled {} by {} with score {:.2f}", subject_text(explanation),
                  verdict.label.text(), verdict.rule.text(), verdict.score);
  const RuleReport* second = runner_up_of(explanation);
  if (second != nullptr)
    text += second_clause(explanation, *second);
  else
    text += "; no rule for another label holds";
  return text + without_evidence_clause(explanation) + ".";
}

void add_line(std::vector<SummaryLine>& lines, std::string text, const Place& place) {
  lines.push_back({{}, std::move(text), place});
}

void add_left_out(std::vector<SummaryLine>& lines, std::size_t count, const std::string& rule) {
  add_line(lines, fmt::format("  and {} more: --rule {}", count, rule), {});
}

/// As one_line(); of terms "score 1.00 x2: b is 0.70 m".
std::string finding_text(const ExplanationRow& row) {
  const bool is_term = row.cells[0].find(" x") != std::string::npos;
  return (is_term ? "score " : "") + one_line(row);
}

/// The first rows of a rule, of what `and` and `or` are made of only the whole.
void add_findings(std::vector<SummaryLine>& lines, const RuleReport& rule) {
  const std::vector<ExplanationRow> rows = rows_of(rule);
  const auto is_shown = [&](const ExplanationRow& row) {
    return row.indent > rows[0].indent && row.indent <= rows[1].indent;
  };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(rows, is_shown));
  const std::size_t most = count > kMostShownFindings ? kMostShownFindings - 1 : count;
  std::size_t shown = 0;
  for (const ExplanationRow& row : rows)
    if (is_shown(row) && ++shown <= most) add_line(lines, "  " + finding_text(row), row.place);
  if (count > most) add_left_out(lines, count - most, rule.id);
}

void add_winner(std::vector<SummaryLine>& lines, const Explanation& explanation) {
  const bool has_label = !explanation.verdict.label.empty();
  const RuleReport* rule = has_label          ? winner_of(explanation)
                           : explanation.best ? &explanation.rules[*explanation.best]
                                              : nullptr;
  if (rule == nullptr) return;
  const std::string evidence =
      rule->evidence ? fmt::format(", with evidence {:.2f}", rule->total()) : "";
  lines.push_back(
      {has_label ? "winner" : "best",
       fmt::format("{} for {}, score {:.2f}{}", rule->id, rule->label, rule->score, evidence),
       rule->place});
  add_findings(lines, *rule);
}

void add_runner_up(std::vector<SummaryLine>& lines, const Explanation& explanation) {
  const RuleReport* second = runner_up_of(explanation);
  if (second == nullptr) return;
  lines.push_back({"runner-up",
                   fmt::format("{} for {}, score {:.2f}", second->id, second->label,
                               std::clamp(second->total(), 0.0, 1.0)),
                   second->place});
}

/// "passage.by_size: height is 1.09 m, must be …": that a condition fails is what a miss means.
std::string miss_text(const MissReport& miss, const ExplanationRow& row) {
  ExplanationRow found = row;
  if (miss.condition.outcome == Outcome::fails) found.cells[0] = "holds";
  return (miss.rule.empty() ? "" : miss.rule + ": ") + one_line(found);
}

void add_nearest_miss(std::vector<SummaryLine>& lines, const Explanation& explanation) {
  if (!explanation.nearest_miss) return;
  const NearestMiss& nearest = *explanation.nearest_miss;
  const RuleReport& rule = explanation.rules[nearest.rule];
  const std::size_t count = nearest.misses.size();
  lines.push_back({"nearest miss", fmt::format("{} for {}", rule.id, rule.label), rule.place});
  const std::size_t most = count > kMostMisses ? kMostMisses - 1 : count;
  for (std::size_t i = 0; i < most; ++i) {
    const MissReport& miss = nearest.misses[i];
    const ExplanationRow row = row_of(miss);
    add_line(lines, "  " + miss_text(miss, row), row.place);
  }
  if (count > most) add_left_out(lines, count - most, rule.id);
}

/// "sill_max 0.60 m -> 0.61 m: door 1.00 by door.ground", "none: no param …".
void add_flip(std::vector<SummaryLine>& lines, const Explanation& explanation) {
  if (!explanation.flip) return;
  const std::string line = flip_line(*explanation.flip);
  const std::string text = line.substr(line.find(": ") + 2);
  const auto& nearest = explanation.flip->nearest;
  lines.push_back({"smallest flip", text, nearest ? nearest->place : Place{}});
}

/// "door, window, window" of a pack with `iterate:`.
void add_rounds(std::vector<SummaryLine>& lines, const Explanation& explanation) {
  constexpr std::size_t kMostRounds = 6;
  const auto& rounds = explanation.rounds;
  if (rounds.empty()) return;
  const std::size_t skipped = rounds.size() > kMostRounds ? rounds.size() - kMostRounds : 0;
  std::string text = skipped > 0 ? fmt::format("after {} more", skipped) : "";
  for (std::size_t i = skipped; i < rounds.size(); ++i) {
    if (!text.empty()) text += ", ";
    text += rounds[i].label.empty() ? "unknown" : rounds[i].label;
  }
  lines.push_back({"rounds", text, {}});
}

std::string aligned(const std::vector<SummaryLine>& lines) {
  std::size_t titles = 0, texts = 0;
  for (const SummaryLine& line : lines) {
    titles = std::max(titles, line.title.size());
    if (line.text.size() <= kWidestText) texts = std::max(texts, line.text.size());
  }
  std::string all;
  for (const SummaryLine& line : lines) {
    std::string text = fmt::format("{:{}}  {}", line.title, titles, line.text);
    if (line.place.line > 0) {
      const std::size_t column = titles + 2 + texts;
      text += std::string(text.size() < column ? column - text.size() : 0, ' ');
      text += "  " + place_text(line.place);
    }
    all += printable(text) + "\n";
  }
  return all;
}

}  // namespace

std::string sentence(const Explanation& explanation) {
  if (!explanation.verdict.label.empty()) return sentence_of_label(explanation);
  std::string text = subject_text(explanation) + " has no label: ";
  if (explanation.best) {
    const RuleReport& best = explanation.rules[*explanation.best];
    text += fmt::format("{} comes first with {} by {}, below the minimum score of {}", best.label,
                        score_text(best.total(), explanation.min_score), best.id,
                        score_text(explanation.min_score, best.total()));
  } else {
    text += "no rule for a label holds";
    if (explanation.nearest_miss)
      text +=
          fmt::format("; {} comes nearest", explanation.rules[explanation.nearest_miss->rule].id);
  }
  return text + without_evidence_clause(explanation) + ".";
}

std::string summary_text(const Explanation& explanation) {
  std::vector<SummaryLine> lines;
  add_rounds(lines, explanation);
  add_winner(lines, explanation);
  add_runner_up(lines, explanation);
  add_nearest_miss(lines, explanation);
  add_flip(lines, explanation);
  const std::size_t rules = explanation.rules.size();
  return correction_line(explanation) + printable(sentence(explanation)) + "\n" + aligned(lines) +
         fmt::format("--full shows {}, --rule NAME one of them.\n",
                     rules == 1 ? "the one rule" : fmt::format("all {} rules", rules));
}

std::string rules_text(const Explanation& explanation, const std::vector<std::size_t>& rules) {
  std::vector<ExplanationRow> rows;
  for (const std::size_t rule : rules)
    for (ExplanationRow& row : rows_of(explanation.rules[rule])) rows.push_back(std::move(row));
  return correction_line(explanation) + printable(sentence(explanation)) + "\n" + table_of(rows);
}

}  // namespace oriel
