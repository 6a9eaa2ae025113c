#include "interpret/evaluate/pair_tests.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/comparisons.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

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

struct ClosedRange {
  double low, high;
};

/// The closed range of the numbers that lie below a bound or above it. No number lies beyond an
/// endless one.
ClosedRange open_range(Op op, double bound) {
  constexpr ClosedRange kNone{kEndless, -kEndless};
  if (op == Op::less)
    return bound == -kEndless ? kNone : ClosedRange{-kEndless, std::nextafter(bound, -kEndless)};
  return bound == kEndless ? kNone : ClosedRange{std::nextafter(bound, kEndless), kEndless};
}

/// By slot the closed range of the numbers that compare so with its bound.
void fill_ranges(Op op, std::span<const double> bounds, std::span<double> low,
                 std::span<double> high) {
  if (op == Op::less || op == Op::greater) {
    for (std::size_t slot = 0; slot < bounds.size(); ++slot) {
      const ClosedRange range = open_range(op, bounds[slot]);
      low[slot] = range.low;
      high[slot] = range.high;
    }
    return;
  }
  const auto set = [&](std::span<double> ends, bool is_bound, double endless) {
    if (is_bound)
      std::ranges::copy(bounds, ends.begin());
    else
      std::ranges::fill(ends, endless);
  };
  set(low, op != Op::less_equal, -kEndless);
  set(high, op != Op::greater_equal, kEndless);
}

bool are_known(std::span<const double> bounds) { return are_all_within(bounds, kEndless); }

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
  NumberBlock block;
  const auto bounds = evaluator_.operand(bound, frame_, block);
  Test& test = add(*measure);
  const std::span low(test.low.data(), bounds.size()), high(test.high.data(), bounds.size());
  fill_ranges(op, bounds, low, high);
  if (measure->is_absolute) std::ranges::transform(high, low.begin(), std::negate<>());
  if (measure->is_reversed) mirror(test);
  if (!are_known(bounds)) let_pass_missing(test);
  return true;
}

bool Evaluator::PairTests::read_range(ExprId value, ExprId low, ExprId high) {
  const auto measure = measure_of(value);
  if (!measure || measure->is_absolute || !is_of_self(low) || !is_of_self(high)) return false;
  NumberBlock block;
  Test& test = add(*measure);
  const auto lows = evaluator_.operand(low, frame_, block);
  bool is_known = are_known(lows);
  std::ranges::copy(lows, test.low.begin());
  const auto highs = evaluator_.operand(high, frame_, block);
  is_known = is_known && are_known(highs);
  std::ranges::copy(highs, test.high.begin());
  if (measure->is_reversed) mirror(test);
  if (!is_known) let_pass_missing(test);
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
    return evaluator_.context_->columns[oriel::at(e.index)].data();
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

/// Adds a test without its ends.
Evaluator::PairTests::Test& Evaluator::PairTests::add(const Measure& measure) {
  Test& test = tests_[size_++];
  test.numbers = measure.numbers;
  test.of_selves = test.block.data();
  if (measure.number_of_self == kNoExpr)
    std::fill_n(test.block.begin(), frame_.size, 0.0);
  else
    test.of_selves = evaluator_.operand(measure.number_of_self, frame_, test.block).data();
  return test;
}

/// Of differences the other way round the ends are mirrored.
void Evaluator::PairTests::mirror(Test& test) const {
  for (std::size_t slot = 0; slot < frame_.size; ++slot)
    std::tie(test.low[slot], test.high[slot]) = std::pair(-test.high[slot], -test.low[slot]);
}

/// What is compared with a missing end is unknown, whatever it is: the end is made endless.
void Evaluator::PairTests::let_pass_missing(Test& test) {
  if (!is_bound_missing_) std::fill_n(best_.begin(), frame_.size, Truth::yes);
  is_bound_missing_ = true;
  for (std::size_t slot = 0; slot < frame_.size; ++slot) {
    double &low = test.low[slot], &high = test.high[slot];
    if (!std::isunordered(low, high)) continue;
    if (std::isnan(low)) low = -kEndless;
    if (std::isnan(high)) high = kEndless;
    best_[slot] = Truth::unknown;
  }
}

}  // namespace oriel::rules
