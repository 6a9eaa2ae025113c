#include "interpret/explain/proof.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace oriel::rules {

namespace {

/// A class that is no predicate is not missed by more or less, nor is a veto.
constexpr double kMissedWhole = 1;
/// Classes of classes are looked into so deep.
constexpr std::size_t kDeepestClass = 8;

}  // namespace

double Prover::gap(const Rule& rule) {
  // A predicate that needs itself comes no nearer that way.
  const auto [known, is_new] = gaps_.try_emplace(&rule, std::numeric_limits<double>::infinity());
  if (!is_new) return known->second;
  double sum = 0;
  looked_into_.push_back(&rule);
  for (const ExprId id : rule.require) sum += rule_gap(id);
  looked_into_.pop_back();
  for (const ExprId id : rule.unless) sum += truth(id) == Truth::no ? 0 : kMissedWhole;
  return gaps_[&rule] = sum;
}

/// As gap(), but looks into the classes that are asked for.
double Prover::rule_gap(ExprId id) {
  const Expr& expr = at(id);
  if (truth(id) == Truth::yes) return 0;
  double sum = 0, least = std::numeric_limits<double>::infinity();
  switch (expr.op) {
    case Op::all_of:
      for (const ExprId arg : expr.args) sum += rule_gap(arg);
      return sum;
    case Op::any_of:
      for (const ExprId arg : expr.args) least = std::min(least, rule_gap(arg));
      return least;
    case Op::is_class: {
      const Rule* nearest = nearest_rule_of(expr);
      return nearest == nullptr ? kMissedWhole : gap(*nearest);
    }
    default:
      return gap(id);
  }
}

/// Null: it is no predicate of the feature itself, asked of another round, or needs itself.
const Rule* Prover::nearest_rule_of(const Expr& is_class) {
  if (is_class.level != 0 || is_class.is_previous || looked_into_.size() > kDeepestClass)
    return nullptr;
  const Rule* nearest = nullptr;
  for (const Rule& rule : pack_->rules) {
    const bool is_of_class = is_within(pack_->classes, rule.label, is_class.index) &&
                             pack_->classes[static_cast<std::size_t>(rule.label)].is_abstract &&
                             std::ranges::find(looked_into_, &rule) == looked_into_.end();
    const double found = is_of_class ? gap(rule) : 0;
    if (found > 0 && found < std::numeric_limits<double>::infinity() &&
        (nearest == nullptr || found < gap(*nearest)))
      nearest = &rule;
  }
  return nearest;
}

std::vector<MissReport> Prover::misses(const Rule& rule) {
  std::vector<MissReport> misses;
  add_misses(rule, {}, misses);
  return misses;
}

void Prover::add_misses(const Rule& rule, const std::string& name,
                        std::vector<MissReport>& misses) {
  looked_into_.push_back(&rule);
  for (const ExprId id : rule.require) add_misses(id, name, misses);
  looked_into_.pop_back();
  for (const ExprId id : rule.unless)
    if (truth(id) != Truth::no) misses.push_back({name, true, condition(id)});
}

void Prover::add_misses(ExprId id, const std::string& rule, std::vector<MissReport>& misses) {
  const Expr& expr = at(id);
  if (truth(id) == Truth::yes) return;
  if (expr.op == Op::all_of) {
    for (const ExprId arg : expr.args) add_misses(arg, rule, misses);
    return;
  }
  if (expr.op == Op::any_of) {
    const auto nearest =
        std::ranges::min_element(expr.args, {}, [&](ExprId arg) { return rule_gap(arg); });
    return add_misses(*nearest, rule, misses);
  }
  const Rule* nearest = expr.op == Op::is_class ? nearest_rule_of(expr) : nullptr;
  if (nearest == nullptr)
    misses.push_back({rule, false, condition(id)});
  else
    add_misses(*nearest, nearest->id, misses);
}

}  // namespace oriel::rules
