#include "interpret/labelling/interpret.h"

#include "interpret/labelling/groups.h"
#include "interpret/labelling/labelling.h"

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

Issue ambiguity(const rules::Pack& pack, const Verdict& verdict, const FeatureTable& table) {
  Issue issue;
  issue.severity = Severity::note;
  issue.code = Code::R260;
  issue.sentence =
      fmt::format("{} {:.2f} is close to {}: margin {:.2f} < {:.2f}", verdict.label, verdict.score,
                  verdict.runner_up.text(), verdict.margin, pack.decide.ambiguous_below);
  issue.place.building = table.building();
  issue.place.feature = table.id(verdict.feature);
  return issue;
}

void add_ambiguities(const rules::Pack& pack, std::span<const rules::Choice> choices,
                     const FeatureTable& table, Interpretation& said) {
  for (std::size_t row = 0; row < choices.size(); ++row)
    if (choices[row].is_ambiguous)
      said.issues.push_back(ambiguity(pack, said.verdicts[row], table));
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
  return building_issue(Severity::warning, Code::R261, table.building(), std::move(sentence));
}

/// The buildings of `context`.
void interpret_all(const rules::Pack& pack, rules::EvaluationContext& context,
                   std::span<const FeaturesOfBuilding> buildings,
                   std::span<Interpretation> results) {
  rules::Labelling labelling(pack, context);
  const auto all_choices = labelling.run();
  auto groups = rules::find_groups(pack, context, buildings);
  std::size_t first = 0;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const FeatureTable& table = *buildings[i].table;
    const auto choices = std::span(all_choices).subspan(first, table.rows());
    first += table.rows();
    results[i].verdicts = verdicts_of(pack, choices);
    if (pack.decide.ambiguous_below > 0) add_ambiguities(pack, choices, table, results[i]);
    results[i].groups = std::move(groups[i]);
  }
  // Packs that are run in rounds go building by building.
  if (const auto rows = labelling.unsettled(); !rows.empty())
    results[0].issues.push_back(unsettled(pack, rows, *buildings[0].table));
}

/// So many of the first as fill a block together. Each building decides how many rounds it takes.
std::size_t size_of_batch(const rules::Pack& pack, std::span<const FeaturesOfBuilding> buildings) {
  std::size_t size = 1, rows = buildings[0].table->rows();
  if (pack.rounds > 0) return size;
  while (size < buildings.size() && rows + buildings[size].table->rows() <= rules::kBlock)
    rows += buildings[size++].table->rows();
  return size;
}

}  // namespace

Interpretation interpret(const RuleBase& base, const FeatureTable& table,
                         const FeatureGraph& graph) {
  const FeaturesOfBuilding building{&table, &graph};
  rules::EvaluationContext context(base.pack(), table, graph);
  Interpretation result;
  interpret_all(base.pack(), context, std::span(&building, 1), std::span(&result, 1));
  return result;
}

std::vector<Interpretation> interpret(const RuleBase& base,
                                      std::span<const FeaturesOfBuilding> buildings) {
  std::vector<Interpretation> results(buildings.size());
  for (std::size_t begin = 0; begin < buildings.size();) {
    const std::size_t size = size_of_batch(base.pack(), buildings.subspan(begin));
    const auto batch = buildings.subspan(begin, size);
    if (size == 1) {
      results[begin] = interpret(base, *batch[0].table, *batch[0].graph);
    } else {
      rules::EvaluationContext context(base.pack(), batch);
      interpret_all(base.pack(), context, batch, std::span(results).subspan(begin, size));
    }
    begin += size;
  }
  return results;
}

}  // namespace oriel
