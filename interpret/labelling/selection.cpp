#include "interpret/labelling/selection.h"

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/read/read_pack.h"
#include "interpret/params/with_params.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace oriel {

namespace {

/// A class that no pack of a person has, and the names of the pack that says what is of it and of
/// the one that it extends.
constexpr const char* kClass = "selected_by_condition";
constexpr const char* kFile = "condition.yaml";
constexpr const char* kBase = "base-of-condition.yaml";

/// The pack that extends kBase and has the condition as its last rule: a predicate,
/// so that it takes part in no decision. `column` is set to that of the condition.
std::string pack_of_condition(const std::string& condition, int& column) {
  const std::string before =
      "  - {id: " + std::string(kClass) + ".rule, label: " + kClass + ", require: ['";
  column = static_cast<int>(before.size()) + 1;
  return "schema: oriel/1\npack: {name: selection, version: 1.0.0}\nextends: " +
         std::string(kBase) + "\nclasses:\n  " + kClass + ": {abstract: true}\nrules:\n" + before +
         condition + "']}\n";
}

Issue refused_condition(std::string sentence) {
  Issue issue;
  issue.code = Code::R220;
  issue.sentence = std::move(sentence);
  issue.place = {"", 1, 1, "", ""};
  return issue;
}

/// What was found in the pack of the condition, as of the condition alone.
std::vector<Issue> issues_of_condition(std::vector<Issue> issues, int column) {
  std::erase_if(issues, [](const Issue& issue) { return issue.severity != Severity::error; });
  for (Issue& issue : issues) {
    if (issue.place.file != kFile) continue;
    issue.place = {"", 1, std::max(1, issue.place.column - column + 1), "", ""};
    issue.excerpt.clear();
  }
  return issues;
}

}  // namespace

std::vector<FeatureId> FeatureSelection::find(const FeatureTable& table,
                                              const FeatureGraph& graph) const {
  std::vector<FeatureId> found;
  const rules::Pack& pack = rules_.pack();
  rules::EvaluationContext context(pack, rules_.values(), table, graph);
  if (context.rows == 0 || pack.rules.empty()) return found;
  rules::Labelling(pack, context).run();
  rules::Evaluator evaluator(pack, context);
  for (const auto& judged : rules::judge(pack, pack.rules.back(), evaluator, context.row_numbers))
    if (judged.truth == rules::Truth::yes) found.push_back(FeatureId{judged.row});
  std::ranges::sort(found);
  return found;
}

Checked<FeatureSelection> read_selection(const std::string& text, const std::string& pack_text,
                                         const std::string& pack_path,
                                         const std::vector<std::string>& assignments) {
  if (text.find_first_of("'\n\r") != std::string::npos)
    return {std::nullopt,
            {refused_condition("a condition stands on one line and has no quotes in it")}};
  const rules::PackFinder beside = rules::finder_for(pack_path);
  const rules::PackFinder find = [&](const std::string& name) {
    return name == kBase ? rules::FoundPack{pack_path, pack_text} : beside(name);
  };
  int column = 0;
  std::string wrapped = pack_of_condition(text, column);
  auto read = rules::read_pack_text(std::move(wrapped), kFile, find);
  Checked<FeatureSelection> result{std::nullopt,
                                   issues_of_condition(std::move(read.issues), column)};
  if (!read.is_good) return result;
  auto changed = with_params(RuleBase(read.pack), assignments);
  result.issues.insert(result.issues.end(), changed.issues.begin(), changed.issues.end());
  if (changed.value) result.value.emplace(std::move(*changed.value));
  return result;
}

}  // namespace oriel
