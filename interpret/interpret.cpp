#include "interpret/interpret.h"

#include "interpret/detail/groups.h"
#include "interpret/detail/labelling.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

/// Without a branch on what was decided: what is said for explanations costs no more than to write
/// it.
std::vector<Verdict> verdicts_of(const rules::Pack& pack,
                                 const std::vector<rules::Choice>& choices) {
  const rules::NamesOfRule* const names = pack.names_of_rules.data() + 1;
  std::vector<Verdict> verdicts(choices.size());
  for (std::size_t row = 0; row < choices.size(); ++row) {
    const rules::Choice& choice = choices[row];
    const rules::NamesOfRule& rule = names[choice.rule];
    verdicts[row] = {
        FeatureId{static_cast<int>(row)}, rule.label, choice.score, choice.margin, rule.id,
        names[choice.runner_up].label};
  }
  return verdicts;
}

Issue ambiguity(const rules::Pack& pack, const Verdict& verdict, const FeatureTable& table) {
  Issue issue;
  issue.severity = Severity::note;
  issue.code = "R260";
  issue.sentence =
      fmt::format("{} {:.2f} is close to {}: margin {:.2f} < {:.2f}", verdict.label, verdict.score,
                  verdict.runner_up.text(), verdict.margin, pack.decide.ambiguous_below);
  issue.place.building = table.building();
  issue.place.feature = table.id(verdict.feature);
  return issue;
}

/// Ids are sorted, so that the sentence does not depend on the order of features.
Issue unsettled(const rules::Pack& pack, const std::vector<int>& rows, const FeatureTable& table) {
  constexpr std::size_t kShown = 5;
  std::vector<std::string> ids;
  for (const int row : rows) ids.push_back(table.id(FeatureId{row}));
  std::ranges::sort(ids);
  const std::size_t more = ids.size() - std::min(ids.size(), kShown);
  ids.resize(ids.size() - more);
  std::string sentence = fmt::format("after {} rounds {} features still change: {}", pack.rounds,
                                     rows.size(), fmt::join(ids, ", "));
  if (more > 0) sentence += fmt::format(" and {} more", more);
  return building_issue(Severity::warning, "R261", table.building(), std::move(sentence));
}

}  // namespace

Interpretation interpret(const RuleBase& base, const FeatureTable& table,
                         const FeatureGraph& graph) {
  const rules::Pack& pack = base.pack();
  rules::Facts facts(pack, table, graph);
  rules::Labelling labelling(pack, facts);
  const auto choices = labelling.run();
  Interpretation result;
  result.verdicts = verdicts_of(pack, choices);
  for (std::size_t row = 0; row < choices.size(); ++row)
    if (choices[row].is_ambiguous)
      result.issues.push_back(ambiguity(pack, result.verdicts[row], table));
  if (const auto rows = labelling.unsettled(); !rows.empty())
    result.issues.push_back(unsettled(pack, rows, table));
  result.groups = rules::find_groups(pack, facts, table);
  return result;
}

}  // namespace oriel
