#include "experiments/plan/plan_grammar.h"
#include "experiments/plan/plan_reader.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

void read_folds(const YamlNode& node, SplitPlan& split, PlanReader& reader) {
  split.kind = SplitPlan::Kind::folds;
  split.folds = read_count(node, "'folds'", 2, reader.findings).value_or(2);
}

void read_held_out(const YamlNode& node, SplitPlan& split, PlanReader& reader) {
  split.kind = SplitPlan::Kind::held_out;
  for (const YamlNode* id : texts_of(node, "'held_out'", reader.findings))
    split.held_out.push_back(id->text);
}

/// `leave_one_out`, `{folds: 5}` or `{held_out: [a, b]}`.
SplitPlan read_split(const YamlNode& node, PlanReader& reader) {
  SplitPlan split;
  split.spot = reader.spot(node.span);
  if (node.kind == YamlNode::Kind::scalar) {
    if (node.text == "leave_one_out")
      split.kind = SplitPlan::Kind::leave_one_out;
    else
      reader.findings.error(Code::R212, node.span,
                            "a split is leave_one_out, {folds: 5} or {held_out: [ID, ID]}, not '" +
                                node.text + "'" + did_you_mean(node.text, {"leave_one_out"}));
    return split;
  }
  const YamlSection section(node, "a split", plan_grammar().keys("split"), reader.findings);
  if (!section.is_map()) return split;
  const YamlNode *folds = section.find("folds"), *held_out = section.find("held_out");
  if ((folds == nullptr) == (held_out == nullptr)) {
    reader.findings.error(Code::R210, node.span,
                          "a split has either 'folds' or 'held_out', or is leave_one_out");
    return split;
  }
  if (folds != nullptr) read_folds(*folds, split, reader);
  if (held_out != nullptr) read_held_out(*held_out, split, reader);
  return split;
}

void read_set(const YamlEntry& entry, PlanReader& reader) {
  SetPlan set;
  set.name = entry.key.text;
  set.spot = reader.spot(entry.key.span);
  YamlSection section(entry.value, fmt::format("the set '{}'", set.name),
                      plan_grammar().keys("set"), reader.findings);
  if (!section.is_map()) return;
  const YamlNode *models = section.find("models"), *features = section.find("features");
  if (models == nullptr && features == nullptr)
    reader.findings.error(
        Code::R210, entry.key.span,
        "a set needs 'models', which are segmented, or 'features', which are stored (or both)");
  set.models = read_plan_patterns(models, "'models'", reader);
  set.features = read_plan_patterns(features, "'features'", reader);
  set.truth = read_plan_patterns(section.require("truth"), "'truth'", reader);
  if (const YamlNode* semantics = section.find("semantics"))
    set.ignores_semantics =
        read_word(*semantics, "'semantics'", {"ignored", "kept"}, reader.findings) != "kept";
  if (const YamlNode* split = section.find("split")) set.split = read_split(*split, reader);
  reader.plan.sets.push_back(std::move(set));
}

}  // namespace

std::vector<FilePattern> read_plan_patterns(const YamlNode* node, const std::string& what,
                                            PlanReader& reader) {
  std::vector<FilePattern> patterns;
  if (node == nullptr) return patterns;
  for (const YamlNode* text : texts_of(*node, what, reader.findings))
    patterns.push_back({text->text, reader.spot(text->span)});
  return patterns;
}

void read_plan_sets(const YamlNode& node, PlanReader& reader) {
  if (!expect_map(node, "'sets'", reader.findings)) return;
  if (node.entries.empty())
    reader.findings.error(Code::R287, node.span, "nothing is measured: there is no set");
  for (const YamlEntry& entry : node.entries) read_set(entry, reader);
}

}  // namespace oriel::rules
