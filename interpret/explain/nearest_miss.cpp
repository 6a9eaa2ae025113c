#include "interpret/evaluate/arithmetic.h"
#include "interpret/explain/proof.h"

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// So many names are printed of those that are in the way.
constexpr std::size_t kMostNamed = 5;
/// What is no comparison of numbers is missed by as much as a number that is twice its bound.
constexpr double kNoMeasure = 1;

double share_of(double distance, double p, double q) {
  const double larger = std::max(std::abs(p), std::abs(q));
  return larger > 0 ? distance / larger : kNoMeasure;
}

/// Whether more of the others would have to answer yes for the comparison to hold, or fewer.
enum class Wanted { neither, more, fewer };

Wanted wanted_of(Op op, double count, double bound) {
  if (std::isnan(count) || std::isnan(bound)) return Wanted::neither;
  if (op == Op::greater || op == Op::greater_equal) return Wanted::more;
  if (op == Op::less || op == Op::less_equal) return Wanted::fewer;
  if (op == Op::equal) return count < bound ? Wanted::more : Wanted::fewer;
  return Wanted::neither;
}

}  // namespace

double Prover::gap(ExprId id) {
  const Expr& expr = at(id);
  const Truth judged = truth(id);
  if (judged == Truth::yes) return 0;
  if (judged == Truth::unknown) return kNoMeasure;
  double sum = 0, least = std::numeric_limits<double>::infinity();
  switch (expr.op) {
    case Op::all_of:
      for (const ExprId arg : expr.args) sum += gap(arg);
      return sum;
    case Op::any_of:
      for (const ExprId arg : expr.args) least = std::min(least, gap(arg));
      return least;
    case Op::in_range: {
      const double value = number(expr.args[0]);
      const double bound = number(expr.args[value < number(expr.args[1]) ? 1 : 2]);
      return share_of(std::abs(value - bound), value, bound);
    }
    case Op::similar: {
      const double x = number(expr.args[0]), y = number(expr.args[1]);
      return share_of(std::abs(x - y), x, y) - number(expr.args[2]);
    }
    case Op::less:
    case Op::less_equal:
    case Op::greater:
    case Op::greater_equal:
    case Op::equal: {
      if (at(expr.args[0]).type != Type::number) return kNoMeasure;
      const double x = number(expr.args[0]), y = number(expr.args[1]);
      return share_of(std::abs(x - y), x, y);
    }
    default:
      return kNoMeasure;
  }
}

std::vector<ExprId> Prover::constraints_of(const Expr& quantifier) const {
  std::vector<ExprId> constraints;
  const auto built_in = static_cast<int>(relation_schema().size());
  if (quantifier.index >= built_in)
    constraints.push_back(
        pack_->relations[static_cast<std::size_t>(quantifier.index - built_in)].where);
  for (const ExprId id : {quantifier.filter, quantifier.join})
    if (id != kNoExpr) constraints.push_back(id);
  return constraints;
}

std::vector<int> Prover::others_of(const Expr& quantifier) const {
  const auto built_in = static_cast<int>(relation_schema().size());
  int relation = quantifier.index;
  if (relation >= built_in)
    relation = pack_->relations[static_cast<std::size_t>(relation - built_in)].within;
  return context_->relations[static_cast<std::size_t>(relation)].others_of(rows_[0]);
}

template <class Report>
void Prover::add_nearest(const Expr& quantifier, Report& report) {
  if (context_ == nullptr || quantifier.level != 0) return;
  const std::vector<ExprId> constraints = constraints_of(quantifier);
  std::optional<std::tuple<double, std::string, int>> nearest;
  for (const int other : others_of(quantifier)) {
    Prover pair(*pack_, *table_, *evaluator_, rows_[0]);
    pair.rows_[1] = other;
    double gap = 0;
    for (const ExprId constraint : constraints) gap += pair.gap(constraint);
    std::tuple found(gap, table_->id(FeatureId{other}), other);
    if (gap > 0 && (!nearest || found < *nearest)) nearest = std::move(found);
  }
  if (!nearest) return;
  Prover pair(*pack_, *table_, *evaluator_, rows_[0]);
  pair.rows_[1] = std::get<int>(*nearest);
  report.nearest = std::get<std::string>(*nearest);
  for (const ExprId constraint : constraints)
    for (ConditionReport& condition : pair.conditions(constraint))
      if (condition.outcome != Outcome::holds)
        report.nearest_misses.push_back(std::move(condition));
}

std::string Prover::in_the_way(const Expr& quantifier, Truth answer) {
  if (context_ == nullptr || quantifier.level != 0) return {};
  std::set<std::string> names;
  for (const int other :
       context_->relations[static_cast<std::size_t>(quantifier.index)].others_of(rows_[0])) {
    Prover pair(*pack_, *table_, *evaluator_, rows_[0]);
    pair.rows_[1] = other;
    Truth found = Truth::yes;
    for (const ExprId id : {quantifier.filter, quantifier.join})
      if (id != kNoExpr) found = std::min(found, pair.truth(id));
    if (found == answer) names.insert(table_->id(FeatureId{other}));
  }
  std::string text = "in the way: ";
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (++count > kMostNamed) return text + fmt::format(" and {} more", names.size() - kMostNamed);
    text += (count == 1 ? "" : ", ") + name;
  }
  return text;
}

/// exists, none and all.
void Prover::judge_others(const Expr& quantifier, ConditionReport& report) {
  if (report.outcome == Outcome::holds) return;
  if (quantifier.op == Op::exists) add_nearest(quantifier, report);
  if (report.outcome != Outcome::fails || quantifier.op == Op::exists) return;
  report.miss = in_the_way(quantifier, quantifier.op == Op::none ? Truth::yes : Truth::no);
}

/// A comparison with count(…).
void Prover::judge_tally(const Expr& comparison, ConditionReport& report) {
  if (context_ == nullptr || comparison.args.size() < 2) return;
  const Expr& tally = at(comparison.args[0]);
  if (tally.op != Op::count) return;
  const double count = number(comparison.args[0]);
  Wanted wanted = wanted_of(comparison.op, count, number(comparison.args[1]));
  if (comparison.op == Op::in_range)
    wanted = count < number(comparison.args[1]) ? Wanted::more : Wanted::fewer;
  if (wanted == Wanted::more) add_nearest(tally, report);
  if (wanted != Wanted::fewer) return;
  const std::string others = in_the_way(tally, Truth::yes);
  if (!others.empty()) report.miss += (report.miss.empty() ? "" : ", ") + others;
}

/// A term that rises with count(…).
void Prover::judge_tally(const ScoreTerm& term, TermReport& report) {
  if (context_ == nullptr || at(term.value).op != Op::count || !term.rise) return;
  const double count = number(term.value);
  if (count < number(term.rise->to)) add_nearest(at(term.value), report);
}

}  // namespace oriel::rules
