#include "interpret/detail/evaluator.h"

#include "interpret/detail/arithmetic.h"
#include "interpret/detail/fold.h"

#include <algorithm>

namespace oriel::rules {

namespace {

/// What stands between two operators, for one block.
using NumberBlock = std::array<double, kBlock>;
using TruthBlock = std::array<Truth, kBlock>;

/// From how many on a count compares with `bound` as all greater ones do.
int enough_for(Op op, double bound) {
  constexpr int any = Evaluator::Enough{}.yes;
  if (std::isnan(bound) || bound >= any) return any;
  const bool is_from_bound_on = op == Op::less || op == Op::greater_equal;
  return static_cast<int>(
      std::max(0.0, is_from_bound_on ? std::ceil(bound) : std::floor(bound) + 1));
}

bool is_any_left(std::span<const Truth> truths) {
  return std::ranges::any_of(truths, [](Truth t) { return t != Truth::no; });
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

void Evaluator::forget() {
  for (const ExprId id : kept_) columns_[static_cast<std::size_t>(id)].clear();
  kept_.clear();
}

void Evaluator::numbers(ExprId id, const Frame& frame, std::span<double> out) {
  const Expr& expr = at(id);
  if (is_constant(expr)) {
    const double value =
        expr.op == Op::constant ? expr.number : fold(*pack_, id, facts_->scale).value_or(kUnknown);
    std::ranges::fill(out, value);
    return;
  }
  if (expr.op == Op::attribute)
    gather(expr, frame, out);
  else if (expr.op == Op::count)
    count(id, frame, out, Enough{}.yes);
  else if (is_aggregate(expr.op))
    aggregate(id, frame, out);
  else
    apply_all(expr, frame, out);
}

void Evaluator::gather(const Expr& expr, const Frame& frame, std::span<double> out) const {
  const auto column = facts_->columns[static_cast<std::size_t>(expr.index)];
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
  const auto right = std::span(block).first(out.size());
  for (std::size_t k = 1; k < expr.args.size(); ++k) {
    numbers(expr.args[k], frame, right);
    apply(expr.op, out, right);
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
      return membership(expr, frame, out);
    case Op::facet_is:
      return facet_kind(expr, frame, out);
    case Op::exists:
    case Op::none:
    case Op::all:
      return quantify(id, frame, out);
    default:
      return compare(expr, frame, out);
  }
}

void Evaluator::flag(const Expr& expr, const Frame& frame, std::span<Truth> out) const {
  NumberBlock block, zeros;
  const auto values = std::span(block).first(out.size());
  const auto zero = std::span(zeros).first(out.size());
  gather(expr, frame, values);
  std::ranges::fill(zero, 0.0);
  rules::compare(Op::not_equal, values, zero, out);
}

void Evaluator::compare(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  const auto left = std::span(first).first(out.size());
  const auto right = std::span(second).first(out.size());
  numbers(expr.args[1], frame, right);
  if (at(expr.args[0]).op == Op::count && is_constant(at(expr.args[1])))
    count(expr.args[0], frame, left, enough_for(expr.op, right.front()));
  else
    numbers(expr.args[0], frame, left);
  rules::compare(expr.op, left, right, out);
}

void Evaluator::in_range(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  TruthBlock third;
  const auto value = std::span(first).first(out.size());
  const auto bound = std::span(second).first(out.size());
  const auto is_below = std::span(third).first(out.size());
  numbers(expr.args[0], frame, value);
  numbers(expr.args[1], frame, bound);
  rules::compare(Op::greater_equal, value, bound, out);
  numbers(expr.args[2], frame, bound);
  rules::compare(Op::less_equal, value, bound, is_below);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::min(out[i], is_below[i]);
}

void Evaluator::in_list(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  NumberBlock first, second;
  TruthBlock third;
  const auto value = std::span(first).first(out.size());
  const auto member = std::span(second).first(out.size());
  const auto is_member = std::span(third).first(out.size());
  numbers(expr.args[0], frame, value);
  std::ranges::fill(out, Truth::no);
  for (std::size_t k = 1; k < expr.args.size(); ++k) {
    numbers(expr.args[k], frame, member);
    rules::compare(Op::equal, value, member, is_member);
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

/// not, and, or. After each argument only the slots that it left open are looked at.
void Evaluator::combine(const Expr& expr, const Frame& frame, std::span<Truth> out) {
  truths(expr.args[0], frame, out);
  if (expr.op == Op::negation) {
    for (Truth& truth : out) truth = negated(truth);
    return;
  }
  const bool is_all = expr.op == Op::all_of;
  TruthBlock next, open;
  Frame rest = frame;
  rest.needed = open.data();
  for (std::size_t k = 1; k < expr.args.size(); ++k) {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const bool is_needed = frame.needed == nullptr || frame.needed[i] != Truth::no;
      open[i] = truth_of(is_needed && out[i] != (is_all ? Truth::no : Truth::yes));
    }
    if (!is_any_left(std::span(open).first(out.size()))) return;
    truths(expr.args[k], rest, std::span(next).first(out.size()));
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = is_all ? std::min(out[i], next[i]) : std::max(out[i], next[i]);
  }
}

void Evaluator::membership(const Expr& expr, const Frame& frame, std::span<Truth> out) const {
  const auto& known = expr.is_previous ? facts_->previous : facts_->membership;
  const auto& members = known[static_cast<std::size_t>(expr.index)];
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = members[static_cast<std::size_t>(rows[i])];
}

void Evaluator::facet_kind(const Expr& expr, const Frame& frame, std::span<Truth> out) const {
  const auto column = facts_->columns[facts_->host_inclination];
  const int* rows = frame.rows[static_cast<std::size_t>(expr.level)];
  const auto kind = static_cast<HostKind>(expr.index);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double inclination = column[static_cast<std::size_t>(rows[i])];
    const bool is_kind = kind_of_facet(pack_->hosts, inclination) == kind;
    out[i] = std::isnan(inclination) ? Truth::unknown : truth_of(is_kind);
  }
}

}  // namespace oriel::rules
