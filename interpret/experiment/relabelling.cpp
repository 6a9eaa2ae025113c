#include "interpret/experiment/relabelling.h"

#include "interpret/evaluate/evaluator.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace oriel::rules {

namespace {

bool is_same_judgement(const Judgement& p, const Judgement& q) {
  return p.row == q.row && p.truth == q.truth && p.score == q.score;
}

}  // namespace

/// Judgements that hold as long as the classes which a rule asks for have the members that they had
/// in the end with the pack as it is.
class Relabelling::Known final : public KnownJudgements {
 public:
  Known(const Relabelling& of, const EvaluationContext& context) : of_(of), context_(context) {}

  [[nodiscard]] const std::vector<Judgement>* of(int rule) const override {
    for (const ClassId id : of_.uses_->classes_of(rule))
      if (context_.membership[oriel::at(id)] != of_.membership_[oriel::at(id)]) return nullptr;
    return of_.is_anew_[oriel::at(rule)] ? &of_.judged_anew_[oriel::at(rule)]
                                         : &of_.judged_[oriel::at(rule)];
  }

 private:
  const Relabelling& of_;
  const EvaluationContext& context_;
};

Relabelling::Relabelling(const Pack& pack, const RuleUses& uses, const FeatureTable& table,
                         const FeatureGraph& graph)
    : pack_(&pack),
      uses_(&uses),
      table_(&table),
      graph_(&graph),
      context_(pack, table, graph),
      judged_anew_(pack.rules.size()),
      is_anew_(pack.rules.size()) {
  choices_ = run(pack, context_, nullptr);
  if (pack.rounds == 0) know_judgements();
}

void Relabelling::know_judgements() {
  membership_ = context_.membership;
  Evaluator evaluator(*pack_, context_);
  for (const Rule& rule : pack_->rules)
    judged_.push_back(judge(*pack_, rule, evaluator, context_.row_numbers));
}

std::vector<Choice> Relabelling::run(const Pack& pack, EvaluationContext& context,
                                     const Known* known) const {
  for (auto& members : context.membership) std::ranges::fill(members, Truth::no);
  context.previous.clear();
  return Labelling(pack, context, known).run();
}

/// Asks the affected rules with the memberships as they were; true if one says something else.
bool Relabelling::ask(const ChangedPack& changed, const RuleUses::Affected& affected,
                      EvaluationContext& context) {
  context.membership = membership_;
  is_anew_.assign(is_anew_.size(), false);
  Evaluator evaluator(changed.pack(), context);
  bool is_other = false;
  for (const int rule : affected.rules) {
    const auto r = oriel::at(rule);
    judged_anew_[r] =
        judge(changed.pack(), changed.pack().rules[r], evaluator, context.row_numbers);
    is_anew_[r] = true;
    is_other = is_other || !std::ranges::equal(judged_anew_[r], judged_[r], is_same_judgement);
  }
  return is_other;
}

const std::vector<Choice>& Relabelling::choices(const ChangedPack& changed,
                                                const RuleUses::Affected& affected) {
  if (affected.rules.empty() && !affected.decides_anew) return choices_;
  std::optional<EvaluationContext> related_anew;
  if (affected.has_other_relations) related_anew.emplace(changed.pack(), *table_, *graph_);
  EvaluationContext& context = related_anew ? *related_anew : context_;
  if (pack_->rounds > 0) return changed_choices_ = run(changed.pack(), context, nullptr);
  if (!ask(changed, affected, context) && !affected.decides_anew) return choices_;
  const Known known(*this, context);
  return changed_choices_ = run(changed.pack(), context, &known);
}

}  // namespace oriel::rules
