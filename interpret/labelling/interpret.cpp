#include "interpret/labelling/interpret.h"

#include "interpret/labelling/groups.h"
#include "interpret/labelling/labelling.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

std::vector<Verdict> verdicts_of(const rules::Pack& pack, std::span<const rules::Choice> choices) {
  const rules::NamesOfRule none;
  const auto names_of = [&](int rule) -> const rules::NamesOfRule& {
    return rule < 0 ? none : pack.names_of_rules[static_cast<std::size_t>(rule)];
  };
  std::vector<Verdict> verdicts(choices.size());
  for (std::size_t row = 0; row < choices.size(); ++row) {
    const rules::Choice& choice = choices[row];
    const rules::NamesOfRule& rule = names_of(choice.rule);
    verdicts[row] = {
        FeatureId{static_cast<int>(row)}, rule.label, choice.score, choice.margin, rule.id,
        names_of(choice.runner_up).label};
  }
  return verdicts;
}

Issue ambiguity(double below, const Verdict& verdict, const FeatureTable& table) {
  Issue issue;
  issue.severity = Severity::note;
  issue.code = Code::R260;
  issue.sentence = fmt::format("{} {:.2f} is close to {}: margin {:.2f} < {:.2f}", verdict.label,
                               verdict.score, verdict.runner_up.text(), verdict.margin, below);
  issue.place.building = table.building();
  issue.place.feature = table.id(verdict.feature);
  return issue;
}

void add_ambiguities(double below, std::span<const rules::Choice> choices,
                     const FeatureTable& table, Interpretation& said) {
  for (std::size_t row = 0; row < choices.size(); ++row)
    if (choices[row].is_ambiguous)
      said.issues.push_back(ambiguity(below, said.verdicts[row], table));
}

/// Ids are sorted, so that the sentence does not depend on the order of features.
Issue unsettled(const std::string& what, const std::vector<int>& rows, const FeatureTable& table) {
  constexpr std::size_t kShown = 5;
  std::vector<std::string> ids;
  for (const int row : rows) ids.push_back(table.id(FeatureId{row}));
  std::ranges::sort(ids);
  const std::size_t more = ids.size() - std::min(ids.size(), kShown);
  ids.resize(ids.size() - more);
  std::string sentence = fmt::format(
      "after {} {}: {}", what,
      counted(rows.size(), "feature still changes", "features still change"), fmt::join(ids, ", "));
  if (more > 0) sentence += fmt::format(" and {} more", more);
  return building_issue(Severity::warning, Code::R261, table.building(), std::move(sentence));
}

}  // namespace

Interpretation interpret(const RuleBase& base, const FeatureTable& table,
                         const FeatureGraph& graph) {
  const rules::Pack& pack = base.pack();
  rules::EvaluationContext context(pack, base.values(), table, graph);
  rules::Labelling labelling(pack, context);
  const auto choices = labelling.run();
  Interpretation result;
  result.verdicts = verdicts_of(pack, choices);
  if (const double below = context.values.ambiguous_below; below > 0)
    add_ambiguities(below, choices, table, result);
  result.groups = rules::find_groups(pack, context, table);
  if (const auto rows = labelling.unsettled(); !rows.empty())
    result.issues.push_back(unsettled(counted(pack.rounds, "round"), rows, table));
  if (const auto& rows = labelling.unsettled_by_evidence(); !rows.empty())
    result.issues.push_back(unsettled(
        fmt::format("{} looks at their neighbours", rules::JointPass::kMostSweeps), rows, table));
  return result;
}

}  // namespace oriel
