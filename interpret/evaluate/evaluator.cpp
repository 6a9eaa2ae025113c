#include "interpret/evaluate/evaluator.h"

#include "interpret/compile/fold.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/comparisons.h"
#include "interpret/evaluate/conjunction.h"

#include <algorithm>

namespace oriel::rules {

namespace {

/// From how many on a count compares with `bound` as all greater ones do.
int enough_for(Op op, double bound) {
  constexpr int any = Evaluator::Enough{}.yes;
  if (std::isnan(bound) || bound >= any) return any;
  const bool is_from_bound_on = op == Op::less || op == Op::greater_equal;
  return static_cast<int>(
      std::max(0.0, is_from_bound_on ? std::ceil(bound) : std::floor(bound) + 1));
}

}  // namespace

HostRange range_of(const Hosts& hosts, HostKind kind) {
  if (kind == HostKind::wall) return hosts.wall;
  return kind == HostKind::roof ? hosts.roof : hosts.ground;
}

HostKind kind_of_facet(const Hosts& hosts, double inclination_deg) {
  const auto is_in = [&](HostRange r) {
    return inclination_deg >= r.low_deg && inclination_deg <= r.high_deg;
  };
  if (is_in(hosts.wall)) return HostKind::wall;
  if (is_in(hosts.roof)) return HostKind::roof;
  return is_in(hosts.ground) ? HostKind::ground : HostKind::none;
}

double Evaluator::constant(const Expr& expr, ExprId id) const {
  if (expr.op == Op::constant) return expr.number;
  return fold(*pack_, id, context_->scale).value_or(kUnknown);
}

void Evaluator::numbers(ExprId id, const Frame& frame, std::span<double> out) {
  const Expr& expr = at(id);
  if (is_constant(expr))
    std::ranges::fill(out, constant(expr, id));
  else if (expr.op == Op::attribute)
    gather(expr, frame, out);
  else if (expr.op == Op::count)
    count(id, frame, out, Enough{}.yes);
  else if (is_aggregate(expr.op))
    aggregate(id, frame, out);
  else
    apply_all(expr, frame, out);
}

/// The numbers, where they stand if they follow each other, else in `block`.
std::span<const double> Evaluator::operand(ExprId id, const Frame& frame, NumberBlock& block) {
  const Expr& expr = at(id);
  if (expr.op == Op::attribute && frame.is_run) {
    const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
    const auto column = context_->columns[static_cast<std::size_t>(expr.index)];
    return column.subspan(static_cast<std::size_t>(rows[0]), frame.size);
  }
  const auto out = std::span(block).first(frame.size);
  if (!distance(expr, frame, out)) numbers(id, frame, out);
  return out;
}

/// abs(x - y) of two attributes, which most conditions on pairs ask for, in one pass; false for
/// everything else.
bool Evaluator::distance(const Expr& expr, const Frame& frame, std::span<double> out) const {
  if (expr.op != Op::absolute || at(expr.args[0]).op != Op::subtract) return false;
  const Expr& x = at(at(expr.args[0]).args[0]);
  const Expr& y = at(at(expr.args[0]).args[1]);
  if (x.op != Op::attribute || y.op != Op::attribute) return false;
  const double* of_x = context_->columns[static_cast<std::size_t>(x.index)].data();
  const double* of_y = context_->columns[static_cast<std::size_t>(y.index)].data();
  const int* rows_of_x = frame.rows[static_cast<std::size_t>(x.level)];
  const int* rows_of_y = frame.rows[static_cast<std::size_t>(y.level)];
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::abs(of_x[rows_of_x[i]] - of_y[rows_of_y[i]]);
  return true;
}

void Evaluator::gather(const Expr& expr, const Frame& frame, std::span<double> out) const {
  const auto column = context_->columns[static_cast<std::size_t>(expr.index)];
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  if (frame.is_run) {
    std::ranges::copy(column.subspan(static_cast<std::size_t>(rows[0]), out.size()), out.begin());
    return;
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = column[static_cast<std::size_t>(rows[i])];
}

void Evaluator::apply_all(const Expr& expr, const Frame& frame, std::span<double> out) {
  numbers(expr.args[0], frame, out);
  if (expr.args.size() == 1) return apply(expr.op, out);
  NumberBlock block;
  for (std::size_t k = 1; k < expr.args.size(); ++k) {
    const Expr& arg = at(expr.args[k]);
    if (is_constant(arg))
      apply(expr.op, out, constant(arg, expr.args[k]));
    else
      apply(expr.op, out, operand(expr.args[k], frame, block));
  }
}

void Evaluator::truths(ExprId id, const Frame& frame, std::span<Truth> out) {
  const Expr& expr = at(id);
  switch (expr.op) {
    case Op::flag:
      return flag(expr, frame, out);
    case Op::in_range:
      return in_range(expr, frame, out);
    case Op::in_list:
      return in_list(expr, frame, out);
    case Op::similar:
      return similar(expr, frame, out);
    case Op::negation:
    case Op::all_of:
    case Op::any_of:
      return combine(expr, frame, out);
    case Op::is_class:
    case Op::facet_is:
      std::ranges::fill(out, Truth::yes);
      return narrow(id, frame, out);
    case Op::exists:
    case Op::none:
    case Op::all:
      return quantify(id, frame, out);
    default:
      return compare(expr, frame, out);
  }
}

void Evaluator::flag(const Expr& expr, const Frame& frame, std::span<Truth> out) const {
  NumberBlock block;
  const auto values = std::span(block).first(out.size());
  gather(expr, frame, values);
  rules::compare(Op::not_equal, values, 0.0, out);
}

void Evaluator::compare(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  const Expr& right = at(expr.args[1]);
  if (!is_constant(right)) {
    const auto left = operand(expr.args[0], frame, first);
    return rules::compare(expr.op, left, operand(expr.args[1], frame, second), out);
  }
  const double bound = constant(right, expr.args[1]);
  if (at(expr.args[0]).op == Op::count) {
    const auto left = std::span(first).first(out.size());
    count(expr.args[0], frame, left, enough_for(expr.op, bound));
    return rules::compare(expr.op, left, bound, out);
  }
  rules::compare(expr.op, operand(expr.args[0], frame, first), bound, out);
}

void Evaluator::in_range(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  const auto value = operand(expr.args[0], frame, first);
  const Expr& low = at(expr.args[1]);
  const Expr& high = at(expr.args[2]);
  if (is_constant(low) && is_constant(high))
    return rules::compare_range(value, constant(low, expr.args[1]), constant(high, expr.args[2]),
                                out);
  TruthBlock third;
  const auto is_below = std::span(third).first(out.size());
  rules::compare(Op::greater_equal, value, operand(expr.args[1], frame, second), out);
  rules::compare(Op::less_equal, value, operand(expr.args[2], frame, second), is_below);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::min(out[i], is_below[i]);
}

void Evaluator::in_list(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  TruthBlock third;
  const auto value = operand(expr.args[0], frame, first);
  const auto is_member = std::span(third).first(out.size());
  std::ranges::fill(out, Truth::no);
  for (std::size_t k = 1; k < expr.args.size(); ++k) {
    rules::compare(Op::equal, value, operand(expr.args[k], frame, second), is_member);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], is_member[i]);
  }
}

void Evaluator::similar(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock left, right, tolerance;
  numbers(expr.args[0], frame, std::span(left).first(out.size()));
  numbers(expr.args[1], frame, std::span(right).first(out.size()));
  numbers(expr.args[2], frame, std::span(tolerance).first(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = is_similar(left[i], right[i], tolerance[i]);
}

/// not, and, or: or is not (not and not).
void Evaluator::combine(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  using enum Conjunction::As;
  if (expr.op == Op::negation) {
    truths(expr.args[0], frame, out);
  } else {
    Conjunction held(frame, out);
    for (const ExprId id : expr.args)
      if (held.is_open()) held.ask(*this, id, expr.op == Op::all_of ? itself : opposite);
    held.finish();
  }
  if (expr.op == Op::all_of) return;
  for (Truth& truth : out) truth = negated(truth);
}

/// The answers of a test that is known of all features; null for other expressions.
const std::vector<Truth>* Evaluator::known_column(const Expr& expr) const {
  const auto index = static_cast<std::size_t>(expr.index);
  if (expr.op == Op::facet_is) return &context_->hosts[index];
  if (expr.op != Op::is_class) return nullptr;
  return &(expr.is_previous ? context_->previous : context_->membership)[index];
}

void Evaluator::narrow(ExprId id, const Frame& frame, std::span<Truth> all) {
  const Expr& expr = at(id);
  const auto* column = known_column(expr);
  if (column == nullptr) {
    TruthBlock block;
    const auto answers = std::span(block).first(all.size());
    truths(id, frame, answers);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::min(all[i], answers[i]);
    return;
  }
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  const Truth* answers = column->data();
  if (frame.is_run) {
    answers += rows[0];
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::min(all[i], answers[i]);
  } else {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::min(all[i], answers[rows[i]]);
  }
}

}  // namespace oriel::rules
