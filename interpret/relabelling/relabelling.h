#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/pack.h"
#include "interpret/relabelling/rule_uses.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace oriel::rules {

/// One building that is labelled with a pack and then, again and again, with what becomes of it
/// when values or the pack are changed. Only rules are asked again that say something else, or that
/// ask for a class to which other features belong now; where nothing comes of that, no decision is
/// made anew. Table, graph, pack and uses must outlive it.
class Relabelling {
 public:
  Relabelling(const Pack& pack, const PackValues& values, const RuleUses& uses,
              const FeatureTable& table, const FeatureGraph& graph);

  /// What interpret() decides for every feature with the pack and the values as they are.
  [[nodiscard]] const std::vector<Choice>& choices() const { return choices_; }
  /// The same with other values, and a pack in which something is changed, that affect that. Valid
  /// until the next call.
  const std::vector<Choice>& choices(const Pack& changed, const PackValues& values,
                                     const RuleUses::Affected& affected);

  /// The building, with values as they are and the memberships after the last rule; valid until
  /// choices() is asked.
  [[nodiscard]] EvaluationContext& context();

  /// The class that was chosen, or kNoClass.
  static ClassId label_of(const Pack& pack, const Choice& choice) {
    return choice.rule < 0 ? kNoClass : pack.rules[static_cast<std::size_t>(choice.rule)].label;
  }

 private:
  class Known;

  void know_judgements();
  [[nodiscard]] bool is_as_before(const RuleUses::Affected& affected) const;
  void keep(const RuleUses::Affected& affected, const Known& known);
  bool ask(const Pack& changed, const RuleUses::Affected& affected, EvaluationContext& context);
  std::vector<Judgement> judge_anew(const Pack& changed, int rule,
                                    const std::optional<std::vector<ExprId>>& conditions,
                                    Evaluator& evaluator);
  std::vector<Choice> run(const Pack& pack, EvaluationContext& context, const Known* known) const;

  const Pack* pack_;
  PackValues values_;
  const RuleUses* uses_;
  const FeatureTable* table_;
  const FeatureGraph* graph_;
  EvaluationContext context_;
  /// As the pack says; memberships after the last rule, and what each rule says with them of all
  /// features.
  std::vector<Choice> choices_;
  std::vector<std::vector<Truth>> membership_;
  std::vector<std::vector<Judgement>> judged_;
  /// By rule and the conditions of it that a change affects: the features that its others leave.
  std::map<std::pair<int, std::vector<ExprId>>, std::vector<Judgement>> left_by_others_;
  /// What the affected rules say with the same memberships, by rule; and which these are.
  std::vector<std::vector<Judgement>> judged_anew_;
  std::vector<bool> is_anew_;
  /// The last choices that were made anew, and what the affected rules had said.
  std::vector<Choice> changed_choices_;
  std::vector<int> last_rules_;
  std::vector<std::vector<Judgement>> last_judged_;
};

}  // namespace oriel::rules
