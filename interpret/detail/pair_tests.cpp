#include "interpret/detail/pair_tests.h"

#include "interpret/detail/arithmetic.h"
#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace oriel::rules {

namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

bool is_of_order(Op op) {
  return op == Op::less || op == Op::less_equal || op == Op::greater || op == Op::greater_equal;
}

/// The comparison of order that holds where this one does not.
Op complement(Op op) {
  if (op == Op::less) return Op::greater_equal;
  if (op == Op::less_equal) return Op::greater;
  return op == Op::greater ? Op::less_equal : Op::less;
}

/// For bounds that stand in `high`: the closed ranges of the numbers that compare so with them. No
/// number lies beyond an endless bound.
void set_ranges(Op op, std::span<double> low, std::span<double> high) {
  if (op == Op::less || op == Op::less_equal) {
    std::ranges::fill(low, -kEndless);
    if (op == Op::less_equal) return;
    for (std::size_t i = 0; i < low.size(); ++i) {
      if (high[i] == -kEndless) low[i] = kEndless;
      high[i] = std::nextafter(high[i], -kEndless);
    }
    return;
  }
  std::ranges::copy(high, low.begin());
  if (op == Op::equal) return;
  std::ranges::fill(high, kEndless);
  if (op == Op::greater_equal) return;
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (low[i] == kEndless) high[i] = -kEndless;
    low[i] = std::nextafter(low[i], kEndless);
  }
}

void mirror(std::span<double> low, std::span<double> high) {
  for (std::size_t i = 0; i < low.size(); ++i) {
    const double lowest = -high[i];
    high[i] = -low[i];
    low[i] = lowest;
  }
}

}  // namespace

Evaluator::PairTests::PairTests(Evaluator& evaluator, const Expr& quantifier, const Frame& frame)
    : evaluator_(evaluator), frame_(frame), level_(quantifier.level) {
  const ExprId join = quantifier.join;
  if (join == kNoExpr) return;
  const Expr& expr = evaluator.at(join);
  if (expr.op != Op::all_of || expr.args.size() > kMostLeft) {
    if (!read(join)) left_[left_size_++] = join;
    return;
  }
  for (const ExprId id : expr.args)
    if (!read(id)) left_[left_size_++] = id;
}

/// False if it is no such test.
bool Evaluator::PairTests::read(ExprId id) {
  if (size_ == kMost) return false;
  const Expr& expr = evaluator_.at(id);
  if (expr.op == Op::in_range) return read_range(expr.args[0], expr.args[1], expr.args[2]);
  const bool is_negated = expr.op == Op::negation;
  const Expr& asked = is_negated ? evaluator_.at(expr.args[0]) : expr;
  if (!is_of_order(asked.op) && (is_negated || asked.op != Op::equal)) return false;
  const Op op = is_negated ? complement(asked.op) : asked.op;
  return read_comparison(op, asked.args[0], asked.args[1]) ||
         read_comparison(mirrored(op), asked.args[1], asked.args[0]);
}

/// Of |x| only an upper bound makes one range of x. Differences the other way round are exact
/// mirror images, and so are their ranges.
bool Evaluator::PairTests::read_comparison(Op op, ExprId value, ExprId bound) {
  const auto measure = measure_of(value);
  if (!measure || !is_of_self(bound)) return false;
  if (measure->is_absolute && op != Op::less && op != Op::less_equal) return false;
  Test& test = add(*measure);
  const auto high = fill(bound, test.high);
  const auto low = std::span(test.low).first(high.size());
  set_ranges(op, low, high);
  if (measure->is_absolute)
    for (std::size_t i = 0; i < low.size(); ++i) low[i] = -high[i];
  if (measure->is_reversed) mirror(low, high);
  let_pass_missing(low, -kEndless);
  let_pass_missing(high, kEndless);
  return true;
}

bool Evaluator::PairTests::read_range(ExprId value, ExprId low, ExprId high) {
  const auto measure = measure_of(value);
  if (!measure || measure->is_absolute || !is_of_self(low) || !is_of_self(high)) return false;
  Test& test = add(*measure);
  const auto lows = fill(low, test.low);
  const auto highs = fill(high, test.high);
  if (measure->is_reversed) mirror(lows, highs);
  let_pass_missing(lows, -kEndless);
  let_pass_missing(highs, kEndless);
  return true;
}

std::optional<Evaluator::PairTests::Measure> Evaluator::PairTests::measure_of(ExprId id) const {
  const Expr& expr = evaluator_.at(id);
  if (expr.op != Op::absolute) return difference_of(expr);
  auto measure = difference_of(evaluator_.at(expr.args[0]));
  if (!measure) return std::nullopt;
  measure->is_absolute = true;
  measure->is_reversed = false;
  return measure;
}

std::optional<Evaluator::PairTests::Measure> Evaluator::PairTests::difference_of(
    const Expr& expr) const {
  const auto of_other = [&](const Expr& e) -> const double* {
    if (e.op != Op::attribute || e.level != level_ + 1) return nullptr;
    return evaluator_.facts_->columns[oriel::at(e.index)].data();
  };
  if (const double* numbers = of_other(expr)) return Measure{.numbers = numbers};
  if (expr.op != Op::subtract) return std::nullopt;
  for (const bool is_reversed : {false, true}) {
    const double* numbers = of_other(evaluator_.at(expr.args[is_reversed ? 1 : 0]));
    const ExprId number = expr.args[is_reversed ? 0 : 1];
    if (numbers != nullptr && is_of_self(number))
      return Measure{.numbers = numbers, .number_of_self = number, .is_reversed = is_reversed};
  }
  return std::nullopt;
}

/// True if self alone decides it, or nothing at all.
bool Evaluator::PairTests::is_of_self(ExprId id) const {
  return (evaluator_.at(id).levels & ~(1U << static_cast<unsigned>(level_))) == 0;
}

Evaluator::PairTests::Test& Evaluator::PairTests::add(const Measure& measure) {
  Test& test = tests_[size_++];
  test.numbers = measure.numbers;
  if (measure.number_of_self == kNoExpr)
    std::fill_n(test.number.begin(), frame_.size, 0.0);
  else
    fill(measure.number_of_self, test.number);
  return test;
}

std::span<double> Evaluator::PairTests::fill(ExprId id, NumberBlock& block) {
  const auto numbers = std::span(block).first(frame_.size);
  evaluator_.numbers(id, frame_, numbers);
  return numbers;
}

/// What is compared with a missing bound is unknown, whatever it is: the bound is made endless.
void Evaluator::PairTests::let_pass_missing(std::span<double> bounds, double endless) {
  constexpr std::uint64_t kOne = 1;
  std::uint64_t is_missing = 0;  // as wide as a double, so that many are looked at together
  for (const double bound : bounds) is_missing |= bound != bound ? kOne : 0;
  if (is_missing == 0) return;
  if (!is_bound_missing_) std::fill_n(best_.begin(), frame_.size, Truth::yes);
  is_bound_missing_ = true;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!std::isnan(bounds[i])) continue;
    bounds[i] = endless;
    best_[i] = Truth::unknown;
  }
}

}  // namespace oriel::rules
