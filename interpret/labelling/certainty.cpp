#include "interpret/compile/fold.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/comparisons.h"
#include "interpret/evaluate/evaluator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel::rules {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Sums and products below it are far from infinite, so that none of their differences is NaN.
constexpr double kHuge = 1e100;

}  // namespace

bool Evaluator::is_always_known(ExprId id) const {
  const Expr& expr = at(id);
  switch (expr.op) {
    case Op::negation:
    case Op::all_of:
    case Op::any_of:
      return std::ranges::all_of(expr.args, [&](ExprId arg) { return is_always_known(arg); });
    case Op::flag:
      return most_in(static_cast<std::size_t>(expr.index)) < kHuge;
    case Op::facet_is:
      return most_in(column_of(Attribute::host_inclination)) < kHuge;
    case Op::is_class:
      return !has_unknown((expr.is_previous
                               ? context_->previous
                               : context_->membership)[static_cast<std::size_t>(expr.index)]);
    case Op::exists:
    case Op::none:
    case Op::all:
      return false;
    default:
      return std::ranges::all_of(expr.args, [&](ExprId arg) { return most(arg) < kHuge; });
  }
}

/// A bound of the magnitude of a number; infinite where it may be unknown.
double Evaluator::most(ExprId id) const {
  const Expr& expr = at(id);
  if (is_constant(expr)) {
    const double value = std::abs(fold(*pack_, id, context_->scale).value_or(kUnknown));
    return std::isnan(value) ? kInfinity : value;
  }
  double sum = 0, product = 1;
  switch (expr.op) {
    case Op::attribute:
      return most_in(static_cast<std::size_t>(expr.index));
    case Op::negate:
    case Op::add:
    case Op::subtract:
    case Op::absolute:
    case Op::minimum:
    case Op::maximum:
      for (const ExprId arg : expr.args) sum += most(arg);
      return sum;
    case Op::multiply:
      for (const ExprId arg : expr.args) product *= std::max(1.0, most(arg));
      return product < kHuge ? product : kInfinity;
    default:
      return kInfinity;
  }
}

/// What is measured of buildings is far below it; what is not counts as infinite.
double Evaluator::most_in(std::size_t column) const {
  constexpr double kMost = 1e9;
  if (most_in_.empty()) most_in_.resize(context_->columns.size(), kUnknown);
  double& most = most_in_[column];
  if (!std::isnan(most)) return most;
  return most = are_all_within(context_->columns[column], kMost) ? kMost : kInfinity;
}

}  // namespace oriel::rules
