#include "experiments/results/result_rows.h"

#include <cmath>
#include <map>
#include <utility>

namespace oriel {

namespace {

std::map<std::string, ClassScore> sums_of(const RunOutcomes& outcomes) {
  std::map<std::string, ClassScore> sums;
  for (const auto& [building, outcome] : outcomes)
    for (const auto& [label, counts] : outcome.classes) sums[label] += counts;
  return sums;
}

/// Of the classes that the truth has.
ClassScore sum_of_true(const std::map<std::string, ClassScore>& classes) {
  ClassScore sum;
  for (const auto& [label, counts] : classes)
    if (counts.true_positives + counts.false_negatives > 0) sum += counts;
  return sum;
}

void put_counts(const ClassScore& counts, double f1, ResultRow& row) {
  row.counts = counts;
  row.precision = counts.precision();
  row.recall = counts.recall();
  row.f1 = f1;
}

void put_interval(const ConfidenceInterval& interval, ResultRow& row) {
  if (!std::isnan(interval.low)) row.f1_interval = interval;
}

void put_difference(const ClassDifference& difference, ResultRow& row) {
  put_interval(difference.second_interval, row);
  row.difference = PairedDifference{difference.f1, difference.interval, difference.p};
}

}  // namespace

ResultRows::ResultRows(ExperimentPart part, std::string set, RunOutcomes baseline,
                       std::size_t samples)
    : part_(part),
      set_(std::move(set)),
      baseline_(baseline),
      comparer_(std::move(baseline), samples) {}

ResultRow ResultRows::row(const std::string& pack, const RunSetting& setting) const {
  ResultRow row;
  row.part = part_;
  row.set = set_;
  row.pack = pack;
  row.setting = setting;
  return row;
}

std::vector<ResultRow> ResultRows::baseline_rows(const std::string& pack,
                                                 RunSetting setting) const {
  setting.is_baseline = true;
  std::vector<ResultRow> rows = rows_of(pack, setting, baseline_);
  for (ResultRow& row : rows) row.difference.reset();
  return rows;
}

std::vector<ResultRow> ResultRows::rows_of(const std::string& pack, const RunSetting& setting,
                                           const RunOutcomes& outcomes) const {
  const PairedComparison comparison = comparer_.compare(outcomes);
  const auto sums = sums_of(outcomes);
  std::vector<ResultRow> rows;
  for (const auto& [label, difference] : comparison.classes) {
    ResultRow& next = rows.emplace_back(row(pack, setting));
    next.label = label;
    const auto found = sums.find(label);
    const ClassScore counts = found == sums.end() ? ClassScore() : found->second;
    put_counts(counts, counts.f1(), next);
    put_difference(difference, next);
  }
  ResultRow& mean = rows.emplace_back(row(pack, setting));
  put_counts(sum_of_true(sums), comparison.all.second_f1, mean);
  put_difference(comparison.all, mean);
  return rows;
}

}  // namespace oriel
