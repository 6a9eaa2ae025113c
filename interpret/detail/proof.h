#pragma once

#include "interpret/detail/evaluator.h"
#include "interpret/detail/pack.h"
#include "interpret/explain.h"

#include <string>
#include <vector>

namespace oriel::rules {

/// Judges conditions for one feature and says why.
class Prover {
 public:
  Prover(const Pack& pack, const FeatureTable& table, Evaluator& evaluator, int row)
      : pack_(&pack), table_(&table), evaluator_(&evaluator), row_(row) {}

  /// A condition; what `and` joins at its top becomes several.
  std::vector<ConditionReport> conditions(ExprId id);
  ConditionReport condition(ExprId id);
  TermReport term(const ScoreTerm& term);
  /// The frame of the feature.
  [[nodiscard]] Frame frame() const;

 private:
  void compare(const Expr& expr, ConditionReport& report);
  void range(ExprId value, double low, double high, ConditionReport& report);
  void list(const Expr& expr, ConditionReport& report);
  void similarity(const Expr& expr, ConditionReport& report);
  void facet(const Expr& expr, ConditionReport& report);
  void negation(const Expr& expr, ConditionReport& report);

  [[nodiscard]] const Expr& at(ExprId id) const {
    return pack_->code[static_cast<std::size_t>(id)];
  }
  [[nodiscard]] std::string text_of(ExprId id) const;
  double number(ExprId id);
  Truth truth(ExprId id);
  /// "0.61 m", "hole", or "?" where it is missing; apart from `other` if they differ.
  std::string show(ExprId id, double other);
  std::string show_named(ExprId id, double other);
  std::string show_tally(ExprId id);
  std::string show_aggregate(ExprId id, double other);
  [[nodiscard]] std::string show_relation(const Expr& expr) const;
  void find_missing(ExprId id, std::vector<std::string>& missing) const;

  const Pack* pack_;
  const FeatureTable* table_;
  Evaluator* evaluator_;
  int row_;
};

}  // namespace oriel::rules
