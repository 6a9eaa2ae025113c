#include "interpret/evaluate/evaluator.h"

#include "interpret/evaluate/arithmetic.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <numeric>

namespace oriel::rules {

namespace {

/// How a pair answers `all`. Where it is unknown whether the other is one at all, the answer is
/// that of `is none or …`; of every other quantifier it is that of `is one and …`.
Truth answer_of_all(Truth is_other, Truth answer) { return std::max(negated(is_other), answer); }

/// Sorted before they are added, so that the sum does not depend on the order of features.
double mean_of(std::vector<double>& numbers) {
  std::ranges::sort(numbers);
  const double sum = std::accumulate(numbers.begin(), numbers.end(), 0.0);
  return sum / static_cast<double>(numbers.size());
}

}  // namespace

double Evaluator::number(ExprId id, const FeatureRows& rows) {
  const Expr& expr = at(id);
  switch (expr.op) {
    case Op::constant:
      return expr.number;
    case Op::parameter:
      return context_->values.params[oriel::at(expr.index)];
    case Op::scale:
      return context_->scale;
    case Op::map_length:
      return number(expr.args[0], rows) * context_->scale / 1000;
    case Op::attribute:
      return attribute(expr, rows);
    case Op::count:
      return count(expr, rows);
    case Op::least:
    case Op::greatest:
    case Op::mean:
      return aggregate(expr, rows);
    default:
      break;
  }
  double result = operand(expr.args[0], rows);
  if (expr.args.size() == 1) return apply(expr.op, result);
  for (std::size_t k = 1; k < expr.args.size(); ++k)
    result = apply(expr.op, result, operand(expr.args[k], rows));
  return result;
}

Truth Evaluator::truth(ExprId id, const FeatureRows& rows) {
  const Expr& expr = at(id);
  const auto arg = [&](std::size_t k) { return operand(expr.args[k], rows); };
  switch (expr.op) {
    case Op::flag:
      return compare(Op::not_equal, attribute(expr, rows), 0);
    case Op::in_range:
      return std::min(compare(Op::greater_equal, arg(0), arg(1)),
                      compare(Op::less_equal, arg(0), arg(2)));
    case Op::in_list:
      return in_list(expr, rows);
    case Op::similar:
      return is_similar(arg(0), arg(1), arg(2));
    case Op::negation:
      return negated(truth(expr.args[0], rows));
    case Op::all_of:
      return all_hold(expr.args, rows);
    case Op::any_of:
      return any_holds(expr.args, rows);
    case Op::is_class:
      return members_of(expr)[row_of(expr, rows)];
    case Op::facet_is:
      return is_on(expr, row_of(expr, rows));
    case Op::exists:
      return exists(expr, rows);
    case Op::none:
      return negated(exists(expr, rows));
    case Op::all:
      return all(expr, rows);
    default:
      return compare(expr.op, arg(0), arg(1));
  }
}

namespace {

template <class Ask>
void keep(std::vector<Judgement>& judged, Ask ask) {
  std::size_t kept = 0;
  for (Judgement judgement : judged) {
    judgement.truth = std::min(judgement.truth, ask(oriel::at(judgement.row)));
    if (judgement.truth != Truth::no) judged[kept++] = judgement;
  }
  judged.resize(kept);
}

Truth is_among(const std::vector<double>& members, double value) {
  Truth most = Truth::no;
  for (const double member : members) most = std::max(most, compare(Op::equal, value, member));
  return most;
}

}  // namespace

/// What an expression is and what is constant in it is looked at once for all features.
void Evaluator::narrow(std::vector<Judgement>& judged, ExprId condition) {
  if (judged.empty()) return;
  const Expr& expr = at(condition);
  if (expr.op == Op::all_of) {
    for (const ExprId part : expr.args) narrow(judged, part);
  } else if (expr.op == Op::is_class) {
    const auto& members = members_of(expr);
    keep(judged, [&](std::size_t row) { return members[row]; });
  } else if (expr.op == Op::facet_is) {
    keep(judged, [&](std::size_t row) { return is_on(expr, row); });
  } else if (compares_attribute(expr)) {
    narrow_by_attribute(judged, expr);
  } else {
    keep(judged, [&](std::size_t row) { return truth(condition, rows_of(static_cast<int>(row))); });
  }
}

/// With constants only.
bool Evaluator::compares_attribute(const Expr& expr) const {
  const bool is_comparison = expr.op >= Op::less && expr.op <= Op::in_list;
  return is_comparison && at(expr.args[0]).op == Op::attribute &&
         std::all_of(expr.args.begin() + 1, expr.args.end(),
                     [&](ExprId arg) { return is_constant(at(arg)); });
}

void Evaluator::narrow_by_attribute(std::vector<Judgement>& judged, const Expr& expr) {
  const auto values = context_->columns[oriel::at(at(expr.args[0]).index)];
  const auto constant = [&](std::size_t k) { return operand(expr.args[k], rows_of(-1)); };
  if (expr.op == Op::in_list) {
    std::vector<double> members;
    for (std::size_t k = 1; k < expr.args.size(); ++k) members.push_back(constant(k));
    return keep(judged, [&](std::size_t row) { return is_among(members, values[row]); });
  }
  const double bound = constant(1);
  if (expr.op != Op::in_range)
    return keep(judged, [&](std::size_t row) { return compare(expr.op, values[row], bound); });
  const double high = constant(2);
  keep(judged, [&](std::size_t row) {
    return std::min(compare(Op::greater_equal, values[row], bound),
                    compare(Op::less_equal, values[row], high));
  });
}

Truth Evaluator::in_list(const Expr& expr, const FeatureRows& rows) {
  const double value = operand(expr.args[0], rows);
  Truth most = Truth::no;
  for (std::size_t k = 1; k < expr.args.size() && most != Truth::yes; ++k)
    most = std::max(most, compare(Op::equal, value, operand(expr.args[k], rows)));
  return most;
}

Truth Evaluator::all_hold(const std::vector<ExprId>& ids, const FeatureRows& rows) {
  Truth least = Truth::yes;
  for (const ExprId id : ids) {
    least = std::min(least, truth(id, rows));
    if (least == Truth::no) break;
  }
  return least;
}

Truth Evaluator::any_holds(const std::vector<ExprId>& ids, const FeatureRows& rows) {
  Truth most = Truth::no;
  for (const ExprId id : ids) {
    most = std::max(most, truth(id, rows));
    if (most == Truth::yes) break;
  }
  return most;
}

/// Whether the host's facet is of a kind.
Truth Evaluator::is_on(const Expr& expr, std::size_t row) const {
  const double inclination_deg = context_->columns[column_of(Attribute::host_inclination)][row];
  if (std::isnan(inclination_deg)) return Truth::unknown;
  return truth_of(context_->values.kind_of_facet(inclination_deg) ==
                  static_cast<HostKind>(expr.index));
}

void Evaluator::forget() {
  for (const ExprId filter : asked_filters_) filters_[oriel::at(filter)].clear();
  asked_filters_.clear();
}

/// Stays where it is until forget(): the pack has the same expressions meanwhile.
Evaluator::FilterAnswers& Evaluator::answers_of(ExprId filter) {
  if (filters_.size() < pack_->code.size()) filters_.resize(pack_->code.size());
  FilterAnswers& answers = filters_[oriel::at(filter)];
  if (answers.empty()) {
    answers.resize(context_->rows);
    asked_filters_.push_back(filter);
  }
  return answers;
}

Truth Evaluator::passes_filter(const Expr& expr, int other, FilterAnswers& answers) {
  auto& answer = answers[oriel::at(other)];
  if (!answer) answer = truth(expr.filter, rows_of(other, expr.level + 1));
  return *answer;
}

/// Calls `visit` for each feature that the relation of a quantifier leads to: with the features of
/// the pair, whether it is one of the relation, and how it answers the conditions. Goes on while
/// `visit` returns true.
template <class Visit>
void Evaluator::for_each_other(const Expr& expr, FeatureRows rows, Visit visit) {
  const Links& links = context_->relations[oriel::at(expr.index)];
  const int self = rows[oriel::at(expr.level)];
  const auto [begin, end] = links.range_of(self);
  FilterAnswers* answers =
      begin < end && expr.filter != kNoExpr ? &answers_of(expr.filter) : nullptr;
  for (std::size_t link = begin; link < end; ++link) {
    const int other = links.other(link);
    if (other == self) continue;
    rows[oriel::at(expr.level + 1)] = other;
    Truth answer = answers == nullptr ? Truth::yes : passes_filter(expr, other, *answers);
    if (expr.join != kNoExpr && answer != Truth::no)
      answer = std::min(answer, truth(expr.join, rows));
    if (!visit(rows, links.is_other(self, link), answer)) return;
  }
}

Truth Evaluator::exists(const Expr& expr, const FeatureRows& rows) {
  Truth most = Truth::no;
  for_each_other(expr, rows, [&](const FeatureRows&, Truth is_other, Truth answer) {
    most = std::max(most, std::min(is_other, answer));
    return most != Truth::yes;
  });
  return most;
}

/// Holds where there is no other.
Truth Evaluator::all(const Expr& expr, const FeatureRows& rows) {
  Truth least = Truth::yes;
  for_each_other(expr, rows, [&](const FeatureRows&, Truth is_other, Truth answer) {
    least = std::min(least, answer_of_all(is_other, answer));
    return least != Truth::no;
  });
  return least;
}

/// One unknown answer makes the count unknown.
double Evaluator::count(const Expr& expr, const FeatureRows& rows) {
  double yes = 0;
  for_each_other(expr, rows, [&](const FeatureRows&, Truth is_other, Truth answer) {
    const Truth counts = std::min(is_other, answer);
    yes = counts == Truth::unknown ? kUnknown : yes + (counts == Truth::yes ? 1 : 0);
    return !std::isnan(yes);
  });
  return yes;
}

/// One unknown answer or value makes it unknown; of no others there is no least, greatest or mean.
double Evaluator::aggregate(const Expr& expr, const FeatureRows& rows) {
  std::vector<double> numbers;
  bool is_known = true;
  for_each_other(expr, rows, [&](const FeatureRows& pair, Truth is_other, Truth answer) {
    const Truth counts = std::min(is_other, answer);
    if (counts == Truth::no) return true;
    numbers.push_back(number(expr.value, pair));
    is_known = counts == Truth::yes && !std::isnan(numbers.back());
    return is_known;
  });
  if (!is_known || numbers.empty()) return kUnknown;
  if (expr.op == Op::least) return *std::ranges::min_element(numbers);
  if (expr.op == Op::greatest) return *std::ranges::max_element(numbers);
  return mean_of(numbers);
}

Tally Evaluator::tally(ExprId id, const FeatureRows& rows) {
  const Expr& expr = at(id);
  Tally tally;
  for_each_other(expr, rows, [&](const FeatureRows&, Truth is_other, Truth answer) {
    const Truth counts =
        expr.op == Op::all ? answer_of_all(is_other, answer) : std::min(is_other, answer);
    ++(counts == Truth::yes ? tally.yes : counts == Truth::no ? tally.no : tally.unknown);
    return true;
  });
  return tally;
}

}  // namespace oriel::rules
