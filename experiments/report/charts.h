#pragma once

#include "experiments/report/runs.h"
#include "interpret/score/score_spread.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::report {

/// A value with its interval. In a panel of lines it stands at `x`, in a panel of dots on the line
/// called `name`.
struct ChartPoint {
  double x = 0;
  std::string name;
  /// What it belongs to where several are compared; else empty.
  std::string series;
  double y = 0;
  std::optional<ConfidenceInterval> interval;
};

struct ChartPanel {
  std::string title;
  /// "parapet (m)"
  std::string x_title;
  std::vector<ChartPoint> points;
};

/// A figure of a report, in the two forms that people use: how a value depends on a number, a panel
/// a number; or values below each other, in one panel.
struct Chart {
  enum class Kind { lines, dots };
  Kind kind = Kind::lines;
  /// As RunGroup::slug().
  std::string name;
  std::string title;
  std::string y_title;
  std::vector<ChartPanel> panels;
  /// The value of what the others are compared with.
  std::optional<double> reference;
};

/// So many of the largest differences are drawn.
inline constexpr std::size_t kMostDots = 40;

/// The figures of one group. Of numbers that were varied: macro-F1 as it depends on each (of a
/// sweep without those that have no effect). Of ablations that have an effect: the differences, the
/// largest first. Of a comparison and of what was learnt: F1 of
/// each class by run. Values that are none (NaN) are left out.
std::vector<Chart> charts_of(const RunGroup& group);

}  // namespace oriel::report
