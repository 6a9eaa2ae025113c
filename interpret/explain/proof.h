#pragma once

#include "interpret/evaluate/evaluator.h"
#include "interpret/explain/explain.h"
#include "interpret/pack/pack.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::rules {

/// Judges conditions for one feature and says why.
class Prover {
 public:
  Prover(const Pack& pack, const FeatureTable& table, Evaluator& evaluator, int row)
      : pack_(&pack), table_(&table), evaluator_(&evaluator), rows_(rows_of(row)) {}

  /// From now on conditions on others say which of them misses least.
  void look_for_nearest(const EvaluationContext& context) { context_ = &context; }

  /// A condition; what `and` joins at its top becomes several.
  std::vector<ConditionReport> conditions(ExprId id);
  ConditionReport condition(ExprId id);
  /// Without "must be" before the bound of one that fails.
  ConditionReport bare_condition(ExprId id);
  TermReport term(const ScoreTerm& term);

  /// How far a rule is from holding, in shares of the numbers compared: 0 where it holds. A class
  /// that is asked for is as far as the rule of it that misses least.
  double gap(const Rule& rule);
  /// What keeps it from holding; of a class that is asked for what that rule misses.
  std::vector<MissReport> misses(const Rule& rule);

 private:
  void compare(const Expr& expr, ConditionReport& report);
  void range(ExprId value, double low, double high, ConditionReport& report);
  void list(const Expr& expr, ConditionReport& report);
  void similarity(const Expr& expr, ConditionReport& report);
  void facet(const Expr& expr, ConditionReport& report);
  void negation(const Expr& expr, ConditionReport& report);

  // Of rules (nearest_rule.cpp).
  double rule_gap(ExprId id);
  [[nodiscard]] const Rule* nearest_rule_of(const Expr& is_class);
  void add_misses(const Rule& rule, const std::string& name, std::vector<MissReport>& misses);
  void add_misses(ExprId id, const std::string& rule, std::vector<MissReport>& misses);

  // Of others (nearest_miss.cpp).
  /// How far it is from holding, in shares of the numbers compared: 0 where it holds.
  double gap(ExprId id);
  /// The conditions that the other feature has to fulfil, of the relation and after `where`.
  [[nodiscard]] std::vector<ExprId> constraints_of(const Expr& quantifier) const;
  /// Others that the relation leads to, with those it would if its own condition held.
  [[nodiscard]] std::vector<int> others_of(const Expr& quantifier) const;
  template <class Report>
  void add_nearest(const Expr& quantifier, Report& report);
  /// "in the way: f3, f7" for those that answer so.
  std::string in_the_way(const Expr& quantifier, Truth answer);
  void judge_others(const Expr& quantifier, ConditionReport& report);
  void judge_tally(const Expr& comparison, ConditionReport& report);
  void judge_tally(const ScoreTerm& term, TermReport& report);

  [[nodiscard]] const Expr& at(ExprId id) const {
    return pack_->code[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] std::string text_of(ExprId id) const;
  double number(ExprId id) { return evaluator_->number(id, rows_); }
  Truth truth(ExprId id) { return evaluator_->truth(id, rows_); }
  /// "0.61 m", "hole", or "?" where it is missing; apart from `other` if they differ.
  std::string show(ExprId id, double other);
  std::string show_named(ExprId id, double other);
  std::string show_tally(ExprId id);
  std::string show_aggregate(ExprId id, double other);
  [[nodiscard]] std::string show_relation(const Expr& expr) const;
  void find_missing(ExprId id, std::vector<std::string>& missing) const;

  [[nodiscard]] bool is_known(int level) const {
    return rows_[static_cast<std::size_t>(level)] >= 0;
  }
  [[nodiscard]] FeatureId feature_of(const Expr& expr) const {
    return FeatureId{rows_[static_cast<std::size_t>(expr.level)]};
  }

  const Pack* pack_;
  const FeatureTable* table_;
  Evaluator* evaluator_;
  /// Null: nearest misses are not looked for.
  const EvaluationContext* context_ = nullptr;
  /// Of rules whose gap is known; of those at work what they are until then.
  std::map<const Rule*, double> gaps_;
  /// From the rule that is asked about to the one at hand.
  std::vector<const Rule*> looked_into_;
  /// The feature, and for conditions of a pair the other one.
  FeatureRows rows_;
};

}  // namespace oriel::rules
