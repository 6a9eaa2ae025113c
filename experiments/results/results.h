#pragma once

#include "interpret/score/score.h"
#include "interpret/score/score_spread.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// What an experiment is made of.
enum class ExperimentPart { sweep, ablate, compare, stability, learning_curve, learn };

/// "sweep", "ablate", "compare", "stability", "learning_curve", "learn".
std::string to_string(ExperimentPart part);

/// What was set in a run, and how it is called.
struct RunSetting {
  /// "parapet = 0.6 m", "without rule window.in_wall", "noise 2 cm"; never empty, the same for all
  /// rows of a run, and different for different runs of a part on one set.
  std::string name;
  /// What is varied, if it is one number: "parapet", "noise", "buildings"; else empty.
  std::string variable;
  /// Its value as it is plotted, and its unit: "m", "deg", "%", or empty.
  std::optional<double> value;
  std::string unit;
  /// The run that the others of its part and set are compared with.
  bool is_baseline = false;
};

/// How much better a run is than the baseline of its part and set.
struct PairedDifference {
  double f1 = 0;
  /// 95 %, by the bootstrap over buildings.
  ConfidenceInterval interval;
  /// Of the exact McNemar test on true objects: found by only one of the two.
  double p = 1;
};

/// One class in one run on one set of buildings: a row of results.csv.
struct ResultRow {
  ExperimentPart part = ExperimentPart::sweep;
  std::string set;
  /// As the experiment names it.
  std::string pack;
  RunSetting setting;
  /// A class, or "" for the mean of all classes that the truth has (macro-F1), of which `counts`
  /// are the sums.
  std::string label;
  ClassScore counts;
  /// NaN where they have no denominator.
  double precision = 0;
  double recall = 0;
  double f1 = 0;
  std::optional<ConfidenceInterval> f1_interval;
  std::optional<PairedDifference> difference;
};

/// A file, pack or program that the results depend on.
struct ExperimentInput {
  /// "experiment", "models", "features", "truth", "pack".
  std::string kind;
  /// As the experiment names it, relative to its file.
  std::string path;
  std::string sha256;
};

/// A param that was learnt, or a proposal, as it is listed in the report.
struct ReportTable {
  std::string title;
  /// One sentence that says what the table shows.
  std::string caption;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A building in the run that changes most of its labels.
struct ReportBuilding {
  /// "changed-houses-1"
  std::string name;
  /// "house-3 in wide leaves"
  std::string title;
  /// What has changed.
  std::string caption;
  /// The building in the baseline and in the run, side by side; empty: it cannot be drawn.
  std::string svg;
};

/// The buildings of a set that runs label otherwise than the baseline.
struct ChangedBuildings {
  /// Says how many there are, and how many of them are drawn.
  std::string sentence;
  /// Those with the most changed labels, the most first.
  std::vector<ReportBuilding> buildings;
};

/// All that came of an experiment. Rows are ordered by part, then as the experiment has them.
struct ExperimentResults {
  std::string name;
  /// In the author's words, may be empty.
  std::string about;
  std::vector<ResultRow> rows;
  /// Further tables, shown after the plots.
  std::vector<ReportTable> tables;
  /// Of each comparison on a set.
  std::vector<ChangedBuildings> changed{};
  std::vector<ExperimentInput> inputs;
  /// Name and value of each option with its effective value, the seed among them.
  std::vector<std::pair<std::string, std::string>> options;
  /// oriel's version and commit.
  std::string program;
};

}  // namespace oriel
