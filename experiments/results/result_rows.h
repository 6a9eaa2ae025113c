#pragma once

#include "experiments/results/results.h"
#include "interpret/score/paired.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

/// Makes the rows of one part on one set: of its baseline, and of the runs that are compared with
/// it. May be used by several threads.
class ResultRows {
 public:
  /// `samples` of the buildings give the intervals. `baseline` is what the baseline came to.
  ResultRows(ExperimentPart part, std::string set, RunOutcomes baseline, std::size_t samples);

  /// A row for each class that the run or the baseline has, sorted, then the mean (label ""). Of
  /// the mean, precision and recall are those of the sums of the counts, F1 is the macro-F1.
  [[nodiscard]] std::vector<ResultRow> baseline_rows(const std::string& pack,
                                                     RunSetting setting) const;
  /// `outcomes` are of the buildings that the baseline has. Each row has its difference.
  [[nodiscard]] std::vector<ResultRow> rows_of(const std::string& pack, const RunSetting& setting,
                                               const RunOutcomes& outcomes) const;

 private:
  [[nodiscard]] ResultRow row(const std::string& pack, const RunSetting& setting) const;

  ExperimentPart part_;
  std::string set_;
  RunOutcomes baseline_;
  PairedComparer comparer_;
};

}  // namespace oriel
