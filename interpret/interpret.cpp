#include "interpret/interpret.h"

#include "interpret/detail/labelling.h"

#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

const rules::Rule& rule_of(const rules::Pack& pack, int rule) {
  return pack.rules[static_cast<std::size_t>(rule)];
}

const std::string& label_of(const rules::Pack& pack, int rule) {
  return pack.classes[static_cast<std::size_t>(rule_of(pack, rule).label)].name;
}

Verdict verdict_of(const rules::Pack& pack, const rules::Choice& choice, FeatureId feature) {
  Verdict verdict;
  verdict.feature = feature;
  if (choice.rule < 0) return verdict;
  verdict.label = label_of(pack, choice.rule);
  verdict.score = choice.score;
  verdict.margin = choice.margin;
  verdict.rule = rule_of(pack, choice.rule).id;
  if (choice.runner_up >= 0) verdict.runner_up = label_of(pack, choice.runner_up);
  return verdict;
}

Issue ambiguity(const rules::Pack& pack, const Verdict& verdict, const FeatureTable& table) {
  Issue issue;
  issue.severity = Severity::note;
  issue.code = "R260";
  issue.sentence =
      fmt::format("{} {:.2f} is close to {}: margin {:.2f} < {:.2f}", verdict.label, verdict.score,
                  verdict.runner_up, verdict.margin, pack.decide.ambiguous_below);
  issue.place.building = table.building();
  issue.place.feature = table.id(verdict.feature);
  return issue;
}

}  // namespace

Interpretation interpret(const RuleBase& base, const FeatureTable& table,
                         const FeatureGraph& graph) {
  const rules::Pack& pack = base.pack();
  rules::Facts facts(pack, table, graph);
  const auto choices = rules::Labelling(pack, facts).run();
  Interpretation result;
  result.verdicts.reserve(choices.size());
  for (std::size_t row = 0; row < choices.size(); ++row) {
    const FeatureId feature{static_cast<int>(row)};
    result.verdicts.push_back(verdict_of(pack, choices[row], feature));
    if (choices[row].is_ambiguous)
      result.issues.push_back(ambiguity(pack, result.verdicts.back(), table));
  }
  return result;
}

}  // namespace oriel
