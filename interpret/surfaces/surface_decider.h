#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/evaluate/evaluator.h"
#include "interpret/surfaces/surface_rules.h"
#include "interpret/surfaces/surfaces.h"
#include "kernel/model/description/surface_table.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel::rules {

/// A part of the condition of a rule: all of them must hold.
struct SurfaceConjunct {
  ExprId id = kNoExpr;
  /// What it reads is all measured.
  bool is_final = true;
};

/// Finds for rows of a table the first rule that holds.
class SurfaceDecider {
 public:
  /// `more`: what is measured later; null: nothing.
  SurfaceDecider(const SurfaceRules& surfaces, const SurfaceTable& table,
                 const MoreAttributes* more = nullptr);

  /// For each of the rows, in their order, the number of the rule, or -1.
  [[nodiscard]] std::vector<int> decide(std::span<const int> rows);
  /// Those of the rows for which a value that is not measured may matter. The rules before those
  /// that read it do not hold for them and are not asked again.
  [[nodiscard]] const std::vector<int>& undecided() const { return undecided_; }
  /// More is measured than when the rows were decided.
  void look_again();

 private:
  void add_conjuncts(ExprId id, std::vector<SurfaceConjunct>& conjuncts) const;
  [[nodiscard]] bool reads_pending(ExprId id) const;
  [[nodiscard]] int decide(int row);
  [[nodiscard]] Truth all_hold(const std::vector<SurfaceConjunct>& conjuncts, int row);

  const SurfaceRules& surfaces_;
  const MoreAttributes* more_;
  EvaluationContext context_;
  Evaluator evaluator_;
  /// By rule.
  std::vector<std::vector<SurfaceConjunct>> conjuncts_;
  std::size_t first_rule_ = 0, first_doubtful_ = 0;
  std::vector<int> undecided_;
};

}  // namespace oriel::rules
