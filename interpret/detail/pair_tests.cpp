#include "interpret/detail/pair_tests.h"

#include "interpret/detail/arithmetic.h"
#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cmath>
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

struct ClosedRange {
  double low, high;
};

/// The closed range of the numbers that compare so with a bound. No number lies beyond an endless
/// bound.
ClosedRange closed_range(Op op, double bound) {
  constexpr ClosedRange kNone{kEndless, -kEndless};
  switch (op) {
    case Op::less:
      return bound == -kEndless ? kNone : ClosedRange{-kEndless, std::nextafter(bound, -kEndless)};
    case Op::less_equal:
      return {-kEndless, bound};
    case Op::greater:
      return bound == kEndless ? kNone : ClosedRange{std::nextafter(bound, kEndless), kEndless};
    case Op::greater_equal:
      return {bound, kEndless};
    default:
      return {bound, bound};
  }
}

ClosedRange reflected(ClosedRange ends) { return {-ends.high, -ends.low}; }

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
  if (measure->is_absolute && op == Op::less_equal) {
    add(*measure, [&](std::size_t slot) { return ClosedRange{-bounds[slot], bounds[slot]}; });
    return true;
  }
  add(*measure, [&](std::size_t slot) {
    const ClosedRange ends = closed_range(op, bounds[slot]);
    return measure->is_absolute ? ClosedRange{-ends.high, ends.high} : ends;
  });
  return true;
}

bool Evaluator::PairTests::read_range(ExprId value, ExprId low, ExprId high) {
  const auto measure = measure_of(value);
  if (!measure || measure->is_absolute || !is_of_self(low) || !is_of_self(high)) return false;
  NumberBlock first, second;
  const auto lows = evaluator_.operand(low, frame_, first);
  const auto highs = evaluator_.operand(high, frame_, second);
  add(*measure, [&](std::size_t slot) { return ClosedRange{lows[slot], highs[slot]}; });
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

/// Adds the test whether a measure lies between the ends for a slot.
void Evaluator::PairTests::add(const Measure& measure, auto ends_of_slot) {
  Test& test = tests_[size_++];
  test.numbers = measure.numbers;
  NumberBlock block;
  std::span<const double> numbers = std::span(block).first(frame_.size);
  if (measure.number_of_self == kNoExpr)
    std::fill_n(block.begin(), frame_.size, 0.0);
  else
    numbers = evaluator_.operand(measure.number_of_self, frame_, block);
  bool is_missing = false;
  for (std::size_t slot = 0; slot < numbers.size(); ++slot) {
    const ClosedRange given = ends_of_slot(slot);
    const ClosedRange ends = measure.is_reversed ? reflected(given) : given;
    test.of_slot[slot] = {numbers[slot], ends.low, ends.high};
    is_missing |= std::isunordered(ends.low, ends.high);
  }
  if (is_missing) let_pass_missing(test);
}

/// What is compared with a missing end is unknown, whatever it is: the end is made endless.
void Evaluator::PairTests::let_pass_missing(Test& test) {
  if (!is_bound_missing_) std::fill_n(best_.begin(), frame_.size, Truth::yes);
  is_bound_missing_ = true;
  for (std::size_t slot = 0; slot < frame_.size; ++slot) {
    auto& [number, low, high] = test.of_slot[slot];
    if (!std::isunordered(low, high)) continue;
    if (std::isnan(low)) low = -kEndless;
    if (std::isnan(high)) high = kEndless;
    best_[slot] = Truth::unknown;
  }
}

}  // namespace oriel::rules
