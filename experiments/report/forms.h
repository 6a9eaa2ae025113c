#pragma once

#include "experiments/report/charts.h"
#include "experiments/report/runs.h"
#include "experiments/results/results.h"

#include <string>
#include <vector>

namespace oriel::report {

/// A group with its tables and figures.
struct ReportSection {
  RunGroup group;
  std::vector<ReportTable> tables;
  std::vector<Chart> charts;
};

/// results.csv: a line a row, RFC 4180 with LF line ends; numbers have the fewest digits that read
/// back to the same double, what has no value is empty.
std::string csv_of(const std::vector<ResultRow>& rows);

/// Draws a figure as SVG 1.1; each value has a <title>, which viewers show under the pointer.
std::string svg_of(const Chart& chart);

/// report.md, which shows figures/NAME.svg.
std::string markdown_of(const ExperimentResults& results,
                        const std::vector<ReportSection>& sections);
/// tables.tex: a table environment for each table, for the packages booktabs
/// and graphicx; what is wider than the text is made as wide as it.
std::string latex_of(const ExperimentResults& results, const std::vector<ReportSection>& sections);
/// report.html: one file with all that it needs.
std::string html_of(const ExperimentResults& results, const std::vector<ReportSection>& sections);

}  // namespace oriel::report
