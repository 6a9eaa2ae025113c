#include "interpret/relabelling/relabelling.h"

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

bool are_same(const std::vector<Judgement>& p, const std::vector<Judgement>& q) {
  return std::ranges::equal(p, q, is_same_judgement);
}

}  // namespace

/// Judgements that hold as long as the classes which a rule asks for have the members that they had
/// in the end with the pack as it is.
class Relabelling::Known final : public KnownJudgements {
 public:
  Known(const Relabelling& of, const EvaluationContext& context) : of_(of), context_(context) {}

  [[nodiscard]] const std::vector<Judgement>* of(int rule) const override {
    const bool is_anew = of_.is_anew_[oriel::at(rule)];
    for (const ClassId id : of_.uses_->classes_of(rule)) {
      if (context_.membership[oriel::at(id)] == of_.membership_[oriel::at(id)]) continue;
      has_asked_affected_ = has_asked_affected_ || is_anew;
      return nullptr;
    }
    return is_anew ? &of_.judged_anew_[oriel::at(rule)] : &of_.judged_[oriel::at(rule)];
  }

  /// True if an affected rule had to be asked with other memberships: what it says then is in none
  /// of the judgements that are kept.
  [[nodiscard]] bool has_asked_affected() const { return has_asked_affected_; }

 private:
  const Relabelling& of_;
  const EvaluationContext& context_;
  mutable bool has_asked_affected_ = false;
};

Relabelling::Relabelling(const Pack& pack, const PackValues& values, const RuleUses& uses,
                         const FeatureTable& table, const FeatureGraph& graph)
    : pack_(&pack),
      values_(values),
      uses_(&uses),
      table_(&table),
      graph_(&graph),
      context_(pack, values, table, graph),
      judged_anew_(pack.rules.size()),
      is_anew_(pack.rules.size()) {
  choices_ = run(pack, context_, nullptr);
  membership_ = context_.membership;
  if (pack.rounds == 0) know_judgements();
}

EvaluationContext& Relabelling::context() {
  context_.values = values_;
  context_.membership = membership_;
  return context_;
}

void Relabelling::know_judgements() {
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

/// Asks the affected rules with the memberships as they were; true if one says something else, or
/// may: the members that rules of a recursive step find together are not those of its end alone.
bool Relabelling::ask(const Pack& changed, const RuleUses::Affected& affected,
                      EvaluationContext& context) {
  context.membership = membership_;
  is_anew_.assign(is_anew_.size(), false);
  Evaluator evaluator(changed, context);
  bool is_other = false;
  for (std::size_t i = 0; i < affected.rules.size(); ++i) {
    const int rule = affected.rules[i];
    const auto r = oriel::at(rule);
    judged_anew_[r] = judge_anew(changed, rule, affected.conditions[i], evaluator);
    is_anew_[r] = true;
    is_other = is_other || uses_->is_recursive(rule) || !are_same(judged_anew_[r], judged_[r]);
  }
  return is_other;
}

/// What its other conditions leave is asked once: those say the same with the same memberships.
std::vector<Judgement> Relabelling::judge_anew(const Pack& changed, int rule,
                                               const std::optional<std::vector<ExprId>>& conditions,
                                               Evaluator& evaluator) {
  const Rule& anew = changed.rules[oriel::at(rule)];
  if (!conditions) return judge(changed, anew, evaluator, context_.row_numbers);
  const auto [left, is_new] = left_by_others_.try_emplace({rule, *conditions});
  if (is_new) left->second = judge_without(anew, evaluator, context_.row_numbers, *conditions);
  return judge_on(changed, anew, evaluator, left->second, *conditions);
}

/// The same rules say the same as when choices were made last, so that the same would be chosen.
bool Relabelling::is_as_before(const RuleUses::Affected& affected) const {
  if (affected.decides_anew || affected.rules != last_rules_) return false;
  for (std::size_t i = 0; i < last_rules_.size(); ++i)
    if (!are_same(judged_anew_[oriel::at(last_rules_[i])], last_judged_[i])) return false;
  return true;
}

/// If nothing but these judgements led to the choices.
void Relabelling::keep(const RuleUses::Affected& affected, const Known& known) {
  last_judged_.clear();
  last_rules_.clear();
  if (affected.decides_anew || known.has_asked_affected()) return;
  last_rules_ = affected.rules;
  for (const int rule : last_rules_) last_judged_.push_back(judged_anew_[oriel::at(rule)]);
}

const std::vector<Choice>& Relabelling::choices(const Pack& changed, const PackValues& values,
                                                const RuleUses::Affected& affected) {
  if (affected.rules.empty() && !affected.decides_anew) return choices_;
  std::optional<EvaluationContext> related_anew;
  if (affected.has_other_relations) related_anew.emplace(changed, values, *table_, *graph_);
  EvaluationContext& context = related_anew ? *related_anew : context_;
  context.values = values;
  if (pack_->rounds > 0) return changed_choices_ = run(changed, context, nullptr);
  if (!ask(changed, affected, context) && !affected.decides_anew) return choices_;
  if (is_as_before(affected)) return changed_choices_;
  const Known known(*this, context);
  changed_choices_ = run(changed, context, &known);
  keep(affected, known);
  return changed_choices_;
}

}  // namespace oriel::rules
