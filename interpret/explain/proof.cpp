#include "interpret/explain/proof.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/labelling/labelling.h"
#include "interpret/language/quantity.h"
#include "interpret/pack/names.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

Outcome outcome_of(Truth truth) {
  if (truth == Truth::unknown) return Outcome::unknown;
  return truth == Truth::yes ? Outcome::holds : Outcome::fails;
}

/// "at most" before a bound; nothing for "equal".
const char* words_of(Op op) {
  switch (op) {
    case Op::less:
      return "below ";
    case Op::less_equal:
      return "at most ";
    case Op::greater:
      return "above ";
    case Op::greater_equal:
      return "at least ";
    case Op::equal:
      return "";
    default:
      return "not ";
  }
}

/// What a condition that fails asks for: "must be below 3 m", "must not be hole".
std::string asked_for(const std::string& bound) {
  if (bound.starts_with("not ")) return "must not be " + bound.substr(4);
  return "must be " + bound;
}

const char* yes_or_no(Truth truth) {
  if (truth == Truth::unknown) return "?";
  return truth == Truth::yes ? "yes" : "no";
}

std::string misses_by(double distance, Dimension dimension) {
  return distance > 0 ? "misses by " + write_distance(distance, dimension) : "";
}

bool excludes_equal(Op op) { return op == Op::less || op == Op::greater; }

}  // namespace

std::string Prover::text_of(ExprId id) const {
  return std::string(pack_->source.text_of(at(id).span));
}

std::string Prover::show(ExprId id, double other) {
  const Expr& expr = at(id);
  if (expr.type == Type::text && expr.op == Op::constant) return text_of(id);
  const double value = number(id);
  if (std::isnan(value)) return "?";
  if (expr.type == Type::text)
    return table_->texts(
        kAttributes[static_cast<std::size_t>(expr.index)])[feature_of(expr).index()];
  return write(value, expr.dimension, std::isnan(other) ? value : other);
}

std::string Prover::show_named(ExprId id, double other) {
  if (at(id).op == Op::count) return show_tally(id);
  if (is_aggregate(at(id).op)) return show_aggregate(id, other);
  return text_of(id) + " is " + show(id, other);
}

/// "exists(contains where is opening) is 1 of 3".
std::string Prover::show_tally(ExprId id) {
  const Tally tally = evaluator_->tally(id, rows_);
  std::string text = fmt::format("{} is {} of {}", text_of(id), tally.yes, tally.total());
  if (tally.unknown > 0) text += fmt::format(" ({} unknown)", tally.unknown);
  return text;
}

/// "mean(base_height of in_row) is 2.31 m of 4".
std::string Prover::show_aggregate(ExprId id, double other) {
  const Tally tally = evaluator_->tally(id, rows_);
  std::string text = fmt::format("{} is {} of {}", text_of(id), show(id, other), tally.yes);
  if (tally.unknown > 0) text += fmt::format(" ({} unknown)", tally.unknown);
  return text;
}

/// What the relation of a quantifier is, where the pack declares it.
std::string Prover::show_relation(const Expr& expr) const {
  const std::size_t built_in = relation_schema().size();
  const auto number = static_cast<std::size_t>(expr.index);
  if (number < built_in) return "";
  const RelationDefinition& relation = pack_->relations[number - built_in];
  return fmt::format("{}: {} where {}", relation.name,
                     relation_names(*pack_)[static_cast<std::size_t>(relation.within)],
                     text_of(relation.where));
}

void Prover::find_missing(ExprId id, std::vector<std::string>& missing) const {
  if (id == kNoExpr) return;
  const Expr& expr = at(id);
  for (const ExprId arg : expr.args) find_missing(arg, missing);
  const bool is_attribute = expr.op == Op::attribute || expr.op == Op::flag;
  if (!is_known(expr.level) || (!is_attribute && expr.op != Op::facet_is)) return;
  const Attribute attribute = expr.op == Op::facet_is
                                  ? Attribute::host_inclination
                                  : kAttributes[static_cast<std::size_t>(expr.index)];
  const AttributeInfo& info = info_of(attribute);
  const FeatureId feature = feature_of(expr);
  const bool has_value = info.unit == Unit::text ? !table_->text(feature, attribute).empty()
                                                 : table_->number(feature, attribute).has_value();
  if (!has_value && std::ranges::find(missing, info.name) == missing.end())
    missing.push_back(info.name);
}

std::vector<ConditionReport> Prover::conditions(ExprId id) {
  if (at(id).op != Op::all_of) return {condition(id)};
  std::vector<ConditionReport> reports;
  for (const ExprId arg : at(id).args)
    for (ConditionReport& report : conditions(arg)) reports.push_back(std::move(report));
  return reports;
}

ConditionReport Prover::condition(ExprId id) {
  ConditionReport report = bare_condition(id);
  const Op op = at(id).op;
  const bool is_tally = op == Op::exists || op == Op::none || op == Op::all;
  if (report.outcome == Outcome::fails && !report.bound.empty() && !is_tally)
    report.bound = asked_for(report.bound);
  if (report.outcome == Outcome::holds && op == Op::equal && is_constant(at(at(id).args[1])))
    report.bound.clear();  // the value says it
  return report;
}

ConditionReport Prover::bare_condition(ExprId id) {
  const Expr& expr = at(id);
  ConditionReport report;
  report.text = text_of(id);
  report.place = pack_->source.place(expr.span.begin);
  const Truth judged = truth(id);
  report.outcome = outcome_of(judged);
  if (judged == Truth::unknown) find_missing(id, report.missing);
  switch (expr.op) {
    case Op::in_range:
      range(expr.args[0], number(expr.args[1]), number(expr.args[2]), report);
      break;
    case Op::in_list:
      list(expr, report);
      break;
    case Op::similar:
      similarity(expr, report);
      break;
    case Op::flag:
    case Op::is_class:
      report.value = report.text + ": " + yes_or_no(judged);
      break;
    case Op::facet_is:
      facet(expr, report);
      break;
    case Op::negation:
      negation(expr, report);
      break;
    case Op::all_of:
    case Op::any_of:
      for (const ExprId arg : expr.args) report.parts.push_back(condition(arg));
      break;
    case Op::exists:
    case Op::none:
    case Op::all:
      report.value = show_tally(id);
      report.bound = show_relation(expr);
      judge_others(expr, report);
      break;
    default:
      compare(expr, report);
  }
  if (report.outcome != Outcome::fails) report.miss.clear();
  if (report.outcome == Outcome::fails) judge_tally(expr, report);
  return report;
}

void Prover::compare(const Expr& expr, ConditionReport& report) {
  const bool is_turned = is_constant(at(expr.args[0])) && !is_constant(at(expr.args[1]));
  const ExprId left = expr.args[is_turned ? 1 : 0];
  const ExprId right = expr.args[is_turned ? 0 : 1];
  const Op op = is_turned ? mirrored(expr.op) : expr.op;
  const double value = number(left);
  const double bound = number(right);
  const double distance = std::abs(value - bound);
  const Dimension dimension = at(left).dimension;
  report.value = show_named(left, bound);
  report.bound = words_of(op) + show(right, value);
  if (at(right).op != Op::constant) report.bound += " (" + text_of(right) + ")";
  if (at(left).type != Type::number || !excludes_equal(op)) {
    if (at(left).type == Type::number) report.miss = misses_by(distance, dimension);
    return;
  }
  // Two numbers that are written alike would seem to contradict what is said of them.
  const bool is_whole = dimension.is_plain() && value == std::round(value);
  report.miss = distance > 0 || is_whole ? misses_by(distance, dimension) : "equal is not enough";
  if (report.outcome == Outcome::holds && looks_equal(value, bound))
    report.bound += " by " + write_distance(distance, dimension);
}

void Prover::range(ExprId value, double low, double high, ConditionReport& report) {
  const Dimension dimension = at(value).dimension;
  const double found = number(value);
  const double nearest = found < low ? low : high;
  report.value = show_named(value, nearest);
  report.bound =
      fmt::format("within {} .. {}", write(low, dimension, found), write(high, dimension, found));
  report.miss = misses_by(std::abs(found - nearest), dimension);
}

void Prover::list(const Expr& expr, ConditionReport& report) {
  report.value = show_named(expr.args[0], kUnknown);
  std::string members;
  for (std::size_t i = 1; i < expr.args.size(); ++i)
    members += (i > 1 ? ", " : "") + show(expr.args[i], kUnknown);
  report.bound = "one of [" + members + "]";
}

void Prover::similarity(const Expr& expr, ConditionReport& report) {
  const double left = number(expr.args[0]);
  const double right = number(expr.args[1]);
  const double tolerance = number(expr.args[2]);
  report.value = show_named(expr.args[0], right);
  const double larger = std::max(std::abs(left), std::abs(right));
  const double share = std::abs(left - right) / larger;
  report.bound =
      fmt::format("within {} of {}", write_percent(tolerance, tolerance), show(expr.args[1], left));
  const bool is_hair = write_percent(share, tolerance) == write_percent(tolerance, share);
  report.miss =
      fmt::format("differs by {}{}", is_hair ? "just over " : "", write_percent(share, tolerance));
}

void Prover::facet(const Expr& expr, ConditionReport& report) {
  const auto kind = static_cast<HostKind>(expr.index);
  const AngleRange range = evaluator_->values().range_of(kind);
  const auto found = table_->number(feature_of(expr), Attribute::host_inclination);
  constexpr Dimension kAngle{0, 1};
  report.value = "host_inclination is " + (found ? write(*found, kAngle) : "?");
  report.bound =
      fmt::format("within {} .. {}", write(range.low_deg, kAngle), write(range.high_deg, kAngle));
  if (!found) return;
  const double distance = std::max(range.low_deg - *found, *found - range.high_deg);
  if (distance > 0) report.miss = misses_by(distance, kAngle);
}

/// "not natural": what stands below is shown, turned round.
void Prover::negation(const Expr& expr, ConditionReport& report) {
  ConditionReport inner = bare_condition(expr.args[0]);
  if (!inner.parts.empty()) {
    report.parts.push_back(std::move(inner));
    return;
  }
  report.value = inner.bound.empty() ? "not " + inner.value : inner.value;
  if (!inner.bound.empty()) report.bound = "not " + inner.bound;
  const Expr& negated = at(expr.args[0]);
  if (negated.op == Op::exists && inner.outcome == Outcome::holds)
    report.miss = in_the_way(negated, Truth::yes);
}

TermReport Prover::term(const ScoreTerm& term) {
  TermReport report;
  report.text = text_of(term.value);
  report.place = pack_->source.place(at(term.value).span.begin);
  report.weight = term.weight;
  const double judged = judge_term(*pack_, term, *evaluator_, rows_);
  if (std::isnan(judged))
    find_missing(term.value, report.missing);
  else
    report.judged = judged;
  const Dimension dimension = at(term.value).dimension;
  if (at(term.value).type == Type::yes_no) {
    const ConditionReport inner = condition(term.value);
    report.value = inner.value.empty() ? inner.text : inner.value;
    report.bound = inner.bound;
    return report;
  }
  report.value = show_named(term.value, kUnknown);
  const auto describe = [&](const char* verb, const std::optional<Ramp>& ramp) {
    if (!ramp) return;
    const double from = number(ramp->from);
    const double to = number(ramp->to);
    report.bound += fmt::format("{}{} {} .. {}", report.bound.empty() ? "" : ", ", verb,
                                write(from, dimension, to), write(to, dimension, from));
  };
  describe("rises", term.rise);
  describe("falls", term.fall);
  judge_tally(term, report);
  return report;
}

}  // namespace oriel::rules
