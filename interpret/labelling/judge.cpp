#include "interpret/compile/fold.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/conjunction.h"
#include "interpret/labelling/labelling.h"

#include <algorithm>

namespace oriel::rules {

namespace {

using TruthBlock = std::array<Truth, kBlock>;

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

/// Weighted means of the known terms; a feature for which none is known makes the rule unknown.
void score(const Pack& pack, const Rule& rule, Evaluator& evaluator, Conjunction& held,
           std::span<double> scores) {
  const Frame& frame = held.frame();
  std::array<double, kBlock> sum, weight, term;
  std::fill_n(sum.begin(), frame.size, 0.0);
  std::fill_n(weight.begin(), frame.size, 0.0);
  for (const ScoreTerm& t : rule.score) {
    judge_term(pack, t, evaluator, frame, std::span(term).first(frame.size));
    for (std::size_t i = 0; i < frame.size; ++i) {
      if (std::isnan(term[i])) continue;
      sum[i] += t.weight * term[i];
      weight[i] += t.weight;
    }
  }
  for (std::size_t i = 0; i < frame.size; ++i) {
    scores[i] = weight[i] > 0 ? sum[i] / weight[i] : 0;
    if (weight[i] == 0) held.truths()[i] = std::min(held.truths()[i], Truth::unknown);
  }
}

}  // namespace

void judge_term(const Pack& pack, const ScoreTerm& term, Evaluator& evaluator, const Frame& frame,
                std::span<double> out) {
  if (pack.code[static_cast<std::size_t>(term.value)].type == Type::yes_no) {
    TruthBlock truths;
    evaluator.truths(term.value, frame, std::span(truths).first(out.size()));
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = truths[i] == Truth::unknown ? kUnknown : truths[i] == Truth::yes ? 1 : 0;
    return;
  }
  const auto rise = ends_of(pack, term.rise);
  const auto fall = ends_of(pack, term.fall);
  evaluator.numbers(term.value, frame, out);
  for (double& value : out) {
    if (std::isnan(value)) continue;
    const double up = rise ? climb(*rise, value) : 1;
    const double down = fall ? descend(*fall, value) : 1;
    value = std::min(up, down);
  }
}

void judge(const Pack& pack, const Rule& rule, Evaluator& evaluator, Conjunction& held,
           std::span<double> scores) {
  for (const ExprId id : rule.require)
    if (held.is_open()) held.ask(evaluator, id);
  for (const ExprId id : rule.unless)
    if (held.is_open()) held.ask(evaluator, id, Conjunction::As::veto);
  if (!held.is_open() || scores.empty()) return;
  if (rule.score.empty())
    std::fill_n(scores.begin(), held.truths().size(), 1.0);
  else
    score(pack, rule, evaluator, held, scores);
}

void judge(const Pack& pack, const Rule& rule, Evaluator& evaluator, const Frame& frame,
           Judgement& judgement) {
  Conjunction held(frame, std::span(judgement.truth).first(frame.size));
  std::array<double, kBlock> scores;
  judge(pack, rule, evaluator, held, scores);
  const std::size_t size = held.is_open() ? held.truths().size() : 0;
  for (std::size_t i = 0; i < size; ++i) judgement.score[held.slot(i)] = scores[i];
  held.finish();
}

}  // namespace oriel::rules
