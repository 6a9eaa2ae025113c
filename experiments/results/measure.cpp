#include "experiments/results/measure.h"

#include "interpret/labelling/interpret.h"
#include "interpret/score/score.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace oriel {

namespace {

std::vector<Prediction> predictions_of(const Sample& sample, const Interpretation& labels) {
  const FeatureTable& table = sample.features.table;
  std::vector<Prediction> predictions;
  predictions.reserve(labels.verdicts.size());
  for (const Verdict& verdict : labels.verdicts)
    if (!verdict.label.empty())
      predictions.push_back({table.building(), table.id(verdict.feature), verdict.label,
                             sample.boxes[verdict.feature.index()], verdict.score});
  return predictions;
}

bool is_expected(const ExpectedObject& object) {
  static const ScoreOptions options;
  return !is_left_out(object) && !contains(options.not_scored, object.label);
}

OutcomeOfBuilding outcome_of_sample(const VariantCounts& counts, std::size_t variant,
                                    std::size_t at, const Sample& sample) {
  OutcomeOfBuilding outcome;
  const auto of_labels = counts.counts(variant, at);
  for (std::size_t label = 0; label < of_labels.size(); ++label)
    if (!of_labels[label].is_nothing())
      outcome.classes.emplace(counts.labels().names()[label], of_labels[label].score());
  for (std::size_t object = 0; object < sample.truth.size(); ++object)
    if (is_expected(sample.truth[object]) && !counts.is_found(variant, at, object))
      outcome.missed.emplace_back(sample.truth[object].label, sample.truth[object].id);
  std::ranges::sort(outcome.missed);
  return outcome;
}

}  // namespace

RunOutcomes measure(const RuleBase& rules, std::span<const Sample> samples,
                    const ForEachShare& for_each) {
  std::vector<OutcomeOfBuilding> outcomes(samples.size());
  for_each(samples.size(), [&](std::size_t i) {
    const Sample& sample = samples[i];
    const auto labels = interpret(rules, sample.features.table, sample.features.graph);
    outcomes[i] = outcome_of(score(predictions_of(sample, labels), sample.truth));
  });
  RunOutcomes all;
  for (std::size_t i = 0; i < samples.size(); ++i)
    all.emplace(samples[i].features.table.building(), std::move(outcomes[i]));
  return all;
}

RunOutcomes outcomes_of(const VariantCounts& counts, std::size_t variant,
                        std::span<const Sample> samples) {
  RunOutcomes all;
  for (std::size_t i = 0; i < samples.size(); ++i)
    all.emplace(samples[i].features.table.building(),
                outcome_of_sample(counts, variant, i, samples[i]));
  return all;
}

}  // namespace oriel
