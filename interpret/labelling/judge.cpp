#include "interpret/compile/fold.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/labelling/labelling.h"

#include <algorithm>

namespace oriel::rules {

namespace {

/// A ramp's ends at the params' values.
struct Ends {
  double from = 0;
  double to = 0;
};

std::optional<Ends> ends_of(const Pack& pack, const std::optional<Ramp>& ramp) {
  if (!ramp) return std::nullopt;
  return Ends{fold(pack, ramp->from).value_or(kUnknown), fold(pack, ramp->to).value_or(kUnknown)};
}

/// 0 below the ramp, 1 above it; a ramp without width is a step that belongs to the upper side.
double climb(Ends ends, double x) {
  if (x >= ends.to) return 1;
  if (x <= ends.from) return 0;
  return (x - ends.from) / (ends.to - ends.from);
}

/// The same downhill: 1 up to the ramp's start, 0 from its end on.
double descend(Ends ends, double x) {
  if (x <= ends.from) return 1;
  if (x >= ends.to) return 0;
  return (ends.to - x) / (ends.to - ends.from);
}

/// The weighted mean of the known terms; nothing if none is known.
std::optional<double> score(const Pack& pack, const Rule& rule, Evaluator& evaluator,
                            const FeatureRows& rows) {
  double sum = 0, weight = 0;
  for (const ScoreTerm& term : rule.score) {
    const double judged = judge_term(pack, term, evaluator, rows);
    if (std::isnan(judged)) continue;
    sum += term.weight * judged;
    weight += term.weight;
  }
  if (weight == 0) return std::nullopt;
  return sum / weight;
}

}  // namespace

double judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator,
                  const FeatureRows& rows) {
  if (pack.code[static_cast<std::size_t>(term.value)].type == Type::yes_no) {
    const Truth truth = evaluator.truth(term.value, rows);
    return truth == Truth::unknown ? kUnknown : truth == Truth::yes ? 1 : 0;
  }
  const double value = evaluator.number(term.value, rows);
  if (std::isnan(value)) return kUnknown;
  const auto rise = ends_of(pack, term.rise);
  const auto fall = ends_of(pack, term.fall);
  return std::min(rise ? climb(*rise, value) : 1, fall ? descend(*fall, value) : 1);
}

Judgement judge(const Pack& pack, const Rule& rule, Evaluator& evaluator, int row) {
  const FeatureRows rows = rows_of(row);
  const Truth truth = evaluator.all_hold(rule.require, rows);
  if (truth == Truth::no) return {};
  for (const ExprId id : rule.unless)
    if (evaluator.truth(id, rows) == Truth::yes) return {};
  if (truth != Truth::yes || rule.score.empty()) return {truth, 1};
  const auto scored = score(pack, rule, evaluator, rows);
  return scored ? Judgement{Truth::yes, *scored} : Judgement{Truth::unknown, 0};
}

}  // namespace oriel::rules
