#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/pack.h"

#include <array>
#include <optional>
#include <vector>

namespace oriel::rules {

/// The features that an expression speaks of, by level; -1 where there is none.
using FeatureRows = std::array<int, kMostLevels>;

/// One feature, on the level of the one to be labelled or on another one.
inline FeatureRows rows_of(int row, int level = 0) {
  FeatureRows rows;
  rows.fill(-1);
  rows[static_cast<std::size_t>(level)] = row;
  return rows;
}

/// How the others of a quantifier answer.
struct Tally {
  int yes = 0;
  int unknown = 0;
  int no = 0;

  [[nodiscard]] int total() const { return yes + unknown + no; }
};

/// A feature as a rule judges it.
struct Judgement {
  int row = -1;
  Truth truth = Truth::yes;
  /// 0…1.
  double score = 1;
};

/// Evaluates expressions of a pack for features of a building. Both must outlive it.
class Evaluator {
 public:
  Evaluator(const Pack& pack, const EvaluationContext& context)
      : pack_(&pack), context_(&context) {}

  /// The values of the params.
  [[nodiscard]] const PackValues& values() const { return context_->values; }

  /// To be called when memberships or values have changed.
  void forget();

  /// NaN where it is unknown.
  [[nodiscard]] double number(ExprId id, const FeatureRows& rows);
  [[nodiscard]] Truth truth(ExprId id, const FeatureRows& rows);
  /// Whether all of them hold.
  [[nodiscard]] Truth all_hold(const std::vector<ExprId>& ids, const FeatureRows& rows);
  /// Takes the features away for which the condition does not hold; where it is unknown they become
  /// unknown.
  void narrow(std::vector<Judgement>& judged, ExprId condition);
  /// For a quantifier or an aggregate.
  [[nodiscard]] Tally tally(ExprId id, const FeatureRows& rows);

 private:
  [[nodiscard]] const Expr& at(ExprId id) const {
    return pack_->code[static_cast<std::size_t>(id)];
  }

  [[nodiscard]] double attribute(const Expr& expr, const FeatureRows& rows) const {
    return context_->columns[static_cast<std::size_t>(expr.index)][row_of(expr, rows)];
  }
  [[nodiscard]] static std::size_t row_of(const Expr& expr, const FeatureRows& rows) {
    return static_cast<std::size_t>(rows[static_cast<std::size_t>(expr.level)]);
  }
  /// number() for what is compared, which is nearly always an attribute or a constant.
  double operand(ExprId id, const FeatureRows& rows) {
    const Expr& expr = at(id);
    if (expr.op == Op::attribute) return attribute(expr, rows);
    return expr.op == Op::constant ? expr.number : number(id, rows);
  }
  double count(const Expr& expr, const FeatureRows& rows);
  double aggregate(const Expr& expr, const FeatureRows& rows);

  Truth in_list(const Expr& expr, const FeatureRows& rows);
  Truth any_holds(const std::vector<ExprId>& ids, const FeatureRows& rows);
  [[nodiscard]] const std::vector<Truth>& members_of(const Expr& expr) const {
    const auto& classes = expr.is_previous ? context_->previous : context_->membership;
    return classes[static_cast<std::size_t>(expr.index)];
  }
  [[nodiscard]] bool compares_attribute(const Expr& expr) const;
  void narrow_by_attribute(std::vector<Judgement>& judged, const Expr& expr);
  [[nodiscard]] Truth is_on(const Expr& expr, std::size_t row) const;
  Truth exists(const Expr& expr, const FeatureRows& rows);
  Truth all(const Expr& expr, const FeatureRows& rows);

  template <class Visit>
  void for_each_other(const Expr& expr, FeatureRows rows, Visit visit);
  /// How each feature answers the filter of a quantifier, as soon as it was asked.
  using FilterAnswers = std::vector<std::optional<Truth>>;
  FilterAnswers& answers_of(ExprId filter);
  Truth passes_filter(const Expr& expr, int other, FilterAnswers& answers);

  const Pack* pack_;
  const EvaluationContext* context_;
  /// By filter of a quantifier, which reads nothing but the other feature; empty where it was not
  /// asked. And those that were.
  std::vector<FilterAnswers> filters_;
  std::vector<ExprId> asked_filters_;
};

}  // namespace oriel::rules
