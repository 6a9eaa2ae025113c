#pragma once

/// Experiments on rules (docs/experiments.md): load_experiment_file, plan_grammar,
/// check_experiment, run_experiment, report_files.
#include "experiments/plan/experiment_plan.h"  // IWYU pragma: export
#include "experiments/plan/plan_grammar.h"     // IWYU pragma: export
#include "experiments/report/report.h"         // IWYU pragma: export
#include "experiments/results/results.h"       // IWYU pragma: export
#include "kernel/base/issue.h"
#include "kernel/base/parallel.h"  // IWYU pragma: export

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace oriel {

/// How far an experiment is.
struct ExperimentStep {
  /// "features of houses", "sweep on houses".
  std::string what;
  std::size_t done = 0;
  std::size_t all = 0;
};

struct ExperimentOptions {
  /// The version of the program and its commit: features and measurements of another one are made
  /// anew.
  std::string program;
  /// Where features and finished measurements are kept, under names made of hashes of all that they
  /// depend on; empty: nowhere.
  std::string cache;
  /// Finished measurements are taken from there. Results are the same as without.
  bool resumes = false;
  /// The models of each set, and the buildings of these files, are looked at as each other's
  /// neighbours (LabelOptions::neighbours). A building that is disturbed is looked at where it then
  /// stands, among the others as they are.
  bool looks_at_neighbours = false;
  std::vector<std::string> neighbours_of{};
  /// Shares of the work. Results do not depend on it.
  ForEachShare for_each = for_each_in_turn;
  /// Called from one thread, now and then.
  std::function<void(const ExperimentStep&)> observer{};
};

/// What is wrong with the data sets of an experiment: patterns that match nothing, truth and splits
/// that do not fit, R280 to R289. Models are read, and not segmented. Throws InputError for a file
/// that cannot be opened.
std::vector<Issue> check_experiment(const ExperimentPlan& plan);

/// Measures all that an experiment asks for. Issues are those of check_experiment(), and warnings
/// of buildings that could not be segmented (all their objects count as missed) and of runs that
/// were left out, because the pack cannot have these values together. With an error among them
/// nothing was measured, and there is no value. The results depend on the plan, its files and the
/// program only. Throws InputError for a file that cannot be read, OutputError E601 where the cache
/// cannot be written.
Checked<ExperimentResults> run_experiment(const ExperimentPlan& plan,
                                          const ExperimentOptions& options);

/// The files of all data sets of the plan and of its packs, as they are found now.
std::vector<std::string> files_of_experiment(const ExperimentPlan& plan);

}  // namespace oriel
