#include "experiments/report/charts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel::report {

namespace {

ChartPoint point_of(const ResultRow& row) {
  ChartPoint point;
  point.y = row.f1;
  point.interval = row.f1_interval;
  return point;
}

std::string axis_title(const RunSetting& setting) {
  return setting.unit.empty() ? setting.variable
                              : fmt::format("{} ({})", setting.variable, setting.unit);
}

/// A panel for each number that was varied, its points from left to right.
std::vector<ChartPanel> panels_of_variables(const RunGroup& group) {
  std::vector<ChartPanel> panels;
  for (const MeasuredRun& run : group.runs) {
    const RunSetting& setting = run.setting();
    if (setting.variable.empty() || !setting.value || std::isnan(run.mean->f1)) continue;
    auto panel = std::ranges::find(panels, setting.variable, &ChartPanel::title);
    if (panel == panels.end())
      panel = panels.insert(panel, {setting.variable, axis_title(setting), {}});
    ChartPoint point = point_of(*run.mean);
    point.x = *setting.value;
    panel->points.push_back(point);
  }
  for (ChartPanel& panel : panels) std::ranges::stable_sort(panel.points, {}, &ChartPoint::x);
  return panels;
}

Chart chart_of(const RunGroup& group, Chart::Kind kind, std::string y_title) {
  Chart chart;
  chart.kind = kind;
  chart.name = group.slug();
  chart.title = group.title();
  chart.y_title = std::move(y_title);
  return chart;
}

Chart lines_of(const RunGroup& group) {
  Chart chart = chart_of(group, Chart::Kind::lines, "macro-F1");
  chart.panels = panels_of_variables(group);
  if (group.part == ExperimentPart::sweep) {
    const std::vector<std::string> idle = variables_without_effect(group);
    std::erase_if(chart.panels, [&](const ChartPanel& panel) {
      return std::ranges::find(idle, panel.title) != idle.end();
    });
  }
  if (const MeasuredRun* baseline = group.baseline();
      baseline != nullptr && !std::isnan(baseline->mean->f1)) {
    chart.reference = baseline->mean->f1;
    chart.title += fmt::format(" (dashed: {})", baseline->setting().name);
  }
  return chart;
}

Chart differences_of(const RunGroup& group) {
  Chart chart = chart_of(group, Chart::Kind::dots, "difference of macro-F1");
  std::vector<ChartPoint> points;
  for (const MeasuredRun& run : group.runs) {
    const auto& difference = run.mean->difference;
    if (run.setting().is_baseline || !difference || std::isnan(difference->f1)) continue;
    if (!has_effect(group, run)) continue;
    points.push_back({0, run.setting().name, "", difference->f1, difference->interval});
  }
  std::ranges::stable_sort(points, std::ranges::greater(),
                           [](const ChartPoint& point) { return std::abs(point.y); });
  if (points.size() > kMostDots) {
    chart.title += fmt::format(": the {} largest differences of {}", kMostDots, points.size());
    points.resize(kMostDots);
  }
  chart.panels.push_back({"", chart.y_title, std::move(points)});
  chart.reference = 0;
  return chart;
}

Chart classes_of(const RunGroup& group) {
  Chart chart = chart_of(group, Chart::Kind::dots, "F1");
  std::vector<ChartPoint> points;
  const auto add = [&](const ResultRow& row, const std::string& name) {
    if (std::isnan(row.f1)) return;
    ChartPoint point = point_of(row);
    point.name = name;
    point.series = row.setting.name;
    points.push_back(point);
  };
  std::vector<std::string> labels;
  for (const MeasuredRun& run : group.runs)
    for (const ResultRow* row : run.classes) labels.push_back(row->label);
  std::ranges::sort(labels);
  labels.erase(std::ranges::unique(labels).begin(), labels.end());
  for (const std::string& label : labels)
    for (const MeasuredRun& run : group.runs)
      if (const ResultRow* row = row_of(run, label)) add(*row, label);
  for (const MeasuredRun& run : group.runs) add(*run.mean, "macro");
  chart.panels.push_back({"", chart.y_title, std::move(points)});
  return chart;
}

bool has_points(const Chart& chart) {
  return std::ranges::any_of(chart.panels,
                             [](const ChartPanel& panel) { return !panel.points.empty(); });
}

}  // namespace

std::vector<Chart> charts_of(const RunGroup& group) {
  std::vector<Chart> charts;
  switch (group.part) {
    case ExperimentPart::sweep:
    case ExperimentPart::stability:
    case ExperimentPart::learning_curve:
      charts.push_back(lines_of(group));
      break;
    case ExperimentPart::ablate:
      charts.push_back(differences_of(group));
      break;
    case ExperimentPart::compare:
    case ExperimentPart::learn:
      charts.push_back(classes_of(group));
      break;
  }
  std::erase_if(charts, [](const Chart& chart) { return !has_points(chart); });
  return charts;
}

}  // namespace oriel::report
