#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/pairs.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

namespace oriel::rules {

/// The values of the others, for every slot of a block.
struct Evaluator::Values {
  std::array<std::vector<double>, kBlock> numbers;
  /// An answer or a value is unknown, and so is what is made of them.
  std::array<bool, kBlock> is_unknown{};
};

namespace {

/// Sorted before they are added, so that the sum does not depend on the order of features.
double mean_of(std::vector<double>& numbers) {
  std::ranges::sort(numbers);
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  return sum / static_cast<double>(numbers.size());
}

/// Of no others there is no least, greatest or mean.
double aggregate_of(Op op, std::vector<double>& numbers) {
  if (numbers.empty()) return kUnknown;
  if (op == Op::least) return *std::ranges::min_element(numbers);
  if (op == Op::greatest) return *std::ranges::max_element(numbers);
  return mean_of(numbers);
}

}  // namespace

void Evaluator::aggregate(ExprId id, const Frame& frame, std::span<double> out) {
  const Expr& expr = at(id);
  const Links& links = context_->relations[static_cast<std::size_t>(expr.index)];
  const Truth* filter =
      expr.filter == kNoExpr ? nullptr : column(expr.filter, expr.level + 1).answers.data();
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  const auto values = std::make_unique<Values>();
  Pairs pairs;
  for (std::size_t slot = 0; slot < out.size(); ++slot) {
    if (frame.needed != nullptr && frame.needed[slot] == Truth::no) continue;
    const auto [begin, end] = links.range_of(rows[slot]);
    for (std::size_t link = begin; link < end; ++link) {
      const int other = links.other(link);
      const Truth filtered = filter == nullptr ? Truth::yes : filter[oriel::at(other)];
      if (other == rows[slot] || filtered == Truth::no) continue;
      if (pairs.size == kBlock) flush(expr, pairs, *values);
      pairs.add(slot, rows[slot], other, links.is_other(rows[slot], link), filtered);
    }
  }
  if (pairs.size > 0) flush(expr, pairs, *values);
  for (std::size_t slot = 0; slot < out.size(); ++slot)
    out[slot] = values->is_unknown[slot] ? kUnknown : aggregate_of(expr.op, values->numbers[slot]);
}

void Evaluator::flush(const Expr& expr, Pairs& pairs, Values& values) {
  const Frame frame = pairs.frame(expr.level);
  std::array<Truth, kBlock> joined;
  std::array<double, kBlock> numbers_of_others;
  joined.fill(Truth::yes);
  if (expr.join != kNoExpr) truths(expr.join, frame, std::span(joined).first(pairs.size));
  numbers(expr.value, frame, std::span(numbers_of_others).first(pairs.size));
  for (std::size_t i = 0; i < pairs.size; ++i) {
    const Truth truth = std::min({pairs.is_other[i], pairs.filtered[i], joined[i]});
    if (truth == Truth::no) continue;
    const double number = numbers_of_others[i];
    if (truth == Truth::unknown || std::isnan(number))
      values.is_unknown[pairs.slots[i]] = true;
    else
      values.numbers[pairs.slots[i]].push_back(number);
  }
  pairs.size = 0;
}

}  // namespace oriel::rules
