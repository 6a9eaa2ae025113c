#include "interpret/learn/search/param_curve.h"

#include <algorithm>
#include <tuple>

namespace oriel {

void LabelOutcome::add(const LabelOutcome& other) {
  if (counts.size() < other.counts.size()) counts.resize(other.counts.size());
  for (std::size_t i = 0; i < other.counts.size(); ++i) counts[i] += other.counts[i];
  cost += other.cost;
}

void LabelOutcome::subtract(const LabelOutcome& other) {
  for (std::size_t i = 0; i < other.counts.size(); ++i) {
    counts[i].true_positives -= other.counts[i].true_positives;
    counts[i].false_positives -= other.counts[i].false_positives;
    counts[i].false_negatives -= other.counts[i].false_negatives;
  }
  cost -= other.cost;
}

std::vector<CurveStretch> sum_of(std::span<const ParamCurve* const> curves, double low,
                                 double high) {
  struct CurveStep {
    double from = 0;
    std::size_t curve = 0;
    std::size_t piece = 0;
  };
  std::vector<CurveStep> steps;
  CurveStretch at{low, high, {}};
  for (std::size_t c = 0; c < curves.size(); ++c) {
    at.sum.add(curves[c]->pieces.front().outcome);
    for (std::size_t p = 1; p < curves[c]->pieces.size(); ++p)
      steps.push_back({curves[c]->pieces[p].from, c, p});
  }
  std::ranges::sort(steps, {},
                    [](const CurveStep& s) { return std::tuple(s.from, s.curve, s.piece); });
  std::vector<CurveStretch> stretches;
  for (const CurveStep& step : steps) {
    if (step.from > at.from) {
      stretches.push_back(at);
      stretches.back().to = step.from;
      at.from = step.from;
    }
    const auto& pieces = curves[step.curve]->pieces;
    at.sum.subtract(pieces[step.piece - 1].outcome);
    at.sum.add(pieces[step.piece].outcome);
  }
  at.to = high;
  if (at.to > at.from || stretches.empty()) stretches.push_back(std::move(at));
  return stretches;
}

}  // namespace oriel
