#include "interpret/surfaces/surface_decider.h"

#include <algorithm>

namespace oriel::rules {

SurfaceDecider::SurfaceDecider(const SurfaceRules& surfaces, const SurfaceTable& table,
                               const MoreAttributes* more)
    : surfaces_(surfaces),
      more_(more),
      context_(surfaces.pack, table),
      evaluator_(surfaces.pack, context_),
      conjuncts_(surfaces.rules.size()) {
  for (std::size_t r = 0; r < conjuncts_.size(); ++r)
    for (const ExprId id : surfaces.rules[r].when) add_conjuncts(id, conjuncts_[r]);
}

void SurfaceDecider::add_conjuncts(ExprId id, std::vector<SurfaceConjunct>& conjuncts) const {
  const Expr& expr = surfaces_.pack.code[static_cast<std::size_t>(id)];
  if (expr.op == Op::all_of)
    for (const ExprId part : expr.args) add_conjuncts(part, conjuncts);
  else
    conjuncts.push_back({id, !reads_pending(id)});
}

bool SurfaceDecider::reads_pending(ExprId id) const {
  if (more_ == nullptr) return false;
  const Expr& expr = surfaces_.pack.code[static_cast<std::size_t>(id)];
  if (expr.op == Op::attribute || expr.op == Op::flag)
    return more_->is_pending(kSurfaceAttributes[static_cast<std::size_t>(expr.index)]);
  return std::ranges::any_of(expr.args, [&](ExprId arg) { return reads_pending(arg); });
}

void SurfaceDecider::look_again() {
  first_rule_ = first_doubtful_;
  for (auto& of_rule : conjuncts_)
    for (SurfaceConjunct& conjunct : of_rule) conjunct.is_final = !reads_pending(conjunct.id);
}

std::vector<int> SurfaceDecider::decide(std::span<const int> rows) {
  undecided_.clear();
  first_doubtful_ = conjuncts_.size();
  std::vector<int> deciding;
  deciding.reserve(rows.size());
  for (const int row : rows) deciding.push_back(decide(row));
  return deciding;
}

int SurfaceDecider::decide(int row) {
  int deciding = -1;
  bool is_doubtful = false;
  for (std::size_t r = first_rule_; r < conjuncts_.size() && deciding < 0; ++r) {
    const Truth holds = all_hold(conjuncts_[r], row);
    if (holds == Truth::yes) deciding = static_cast<int>(r);
    if (holds != Truth::unknown) continue;
    is_doubtful = true;
    first_doubtful_ = std::min(first_doubtful_, r);
  }
  if (is_doubtful) undecided_.push_back(row);
  return deciding;
}

/// What is unknown for good does not hold.
Truth SurfaceDecider::all_hold(const std::vector<SurfaceConjunct>& conjuncts, int row) {
  const FeatureRows rows = rows_of(row);
  Truth least = Truth::yes;
  for (const SurfaceConjunct& conjunct : conjuncts) {
    const Truth answer = evaluator_.truth(conjunct.id, rows);
    if (answer == Truth::no || (conjunct.is_final && answer == Truth::unknown)) return Truth::no;
    least = std::min(least, answer);
  }
  return least;
}

}  // namespace oriel::rules
