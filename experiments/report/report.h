#pragma once

#include "experiments/results/results.h"

#include <string>
#include <vector>

namespace oriel {

/// A file of a report.
struct ReportFile {
  /// "results.csv", "figures/sweep-houses.svg"
  std::string path;
  std::string text;
};

/// The files that an experiment leaves behind: results.csv, report.md with figures/*.svg,
/// tables.tex, report.html, which needs nothing else, and manifest.json, which has the hashes of
/// the inputs and of the other files. They depend on `results` alone.
std::vector<ReportFile> report_files(const ExperimentResults& results);

}  // namespace oriel
