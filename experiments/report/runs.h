#pragma once

#include "experiments/results/results.h"

#include <string>
#include <vector>

namespace oriel::report {

/// One setting on one set of buildings. Refers to the rows.
struct MeasuredRun {
  /// The row of the mean of all classes.
  const ResultRow* mean = nullptr;
  /// In the order of the rows.
  std::vector<const ResultRow*> classes;

  [[nodiscard]] const RunSetting& setting() const { return mean->setting; }
};

/// The runs of one part on one set of buildings: they are compared with each other.
struct RunGroup {
  ExperimentPart part = ExperimentPart::sweep;
  std::string set;
  /// In the order of the rows.
  std::vector<MeasuredRun> runs;

  /// The first that is marked so; null if none is.
  [[nodiscard]] const MeasuredRun* baseline() const;
  /// "Sweep on houses"
  [[nodiscard]] std::string title() const;
  /// "sweep-houses", the part as the experiment has it: as names of files and labels have it, of
  /// small letters, digits and hyphens.
  [[nodiscard]] std::string slug() const;
};

/// The rows of an experiment by group and run, in the order in which these first occur. Throws
/// std::invalid_argument for a run without a row of the mean.
std::vector<RunGroup> groups_of(const std::vector<ResultRow>& rows);

/// The numbers that were varied, in the order of the rows, of which no run differs from the others
/// in any class: they have no effect on that set.
std::vector<std::string> variables_without_effect(const RunGroup& group);

/// False: the run has the counts of the baseline in every class.
bool has_effect(const RunGroup& group, const MeasuredRun& run);

/// The row of a class in a run; null if it has none.
const ResultRow* row_of(const MeasuredRun& run, const std::string& label);

/// Of a run that has a difference: the class whose F1 changed most, as in "door -0.120"; empty if
/// none has changed or the run has no differences.
std::string most_changed_class(const MeasuredRun& run);

}  // namespace oriel::report
