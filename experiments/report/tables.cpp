#include "experiments/report/tables.h"

#include "experiments/report/cells.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::report {

namespace {

constexpr double kLowest = -std::numeric_limits<double>::infinity();

/// What has no value is below all others.
double f1_of(const MeasuredRun* run) { return std::isnan(run->mean->f1) ? kLowest : run->mean->f1; }

/// The runs in which one number was varied, by its name, in the order of the rows.
std::vector<std::pair<std::string, std::vector<const MeasuredRun*>>> by_variable(
    const RunGroup& group) {
  std::vector<std::pair<std::string, std::vector<const MeasuredRun*>>> variables;
  for (const MeasuredRun& run : group.runs) {
    const std::string& name = run.setting().variable;
    if (name.empty()) continue;
    auto found = std::ranges::find(variables, name, [](const auto& pair) { return pair.first; });
    if (found == variables.end()) found = variables.insert(found, {name, {}});
    found->second.push_back(&run);
  }
  return variables;
}

std::string intervals_sentence(const RunGroup& group) {
  const bool has_any = std::ranges::any_of(
      group.runs, [](const MeasuredRun& run) { return run.mean->f1_interval.has_value(); });
  return has_any ? " In brackets: 95 % intervals, by the bootstrap over buildings." : "";
}

std::string differences_sentence(const RunGroup& group) {
  const MeasuredRun* baseline = group.baseline();
  if (baseline == nullptr) return "";
  return fmt::format(
      " Differences are from '{}'; p is that of McNemar's exact test on the true objects, found or "
      "missed: wrong predictions do not enter it.",
      baseline->setting().name);
}

/// "0.6 m"
std::string value_of(const MeasuredRun& run) {
  const RunSetting& setting = run.setting();
  if (!setting.value) return setting.name;
  const std::string number = shortest(*setting.value);
  return setting.unit.empty() ? number : fmt::format("{} {}", number, setting.unit);
}

/// The best and the worst run of a param, the pack's own value among them: of equal ones that.
struct ParamExtremes {
  std::string name;
  const MeasuredRun* best = nullptr;
  const MeasuredRun* worst = nullptr;

  [[nodiscard]] double spread() const {
    return f1_of(best) == kLowest ? 0 : f1_of(best) - f1_of(worst);
  }
};

/// The params that matter most first.
std::vector<ParamExtremes> extremes_of(const RunGroup& group) {
  std::vector<ParamExtremes> params;
  for (auto& [name, runs] : by_variable(group)) {
    if (const MeasuredRun* baseline = group.baseline()) runs.insert(runs.begin(), baseline);
    params.push_back({name, *std::ranges::max_element(runs, {}, f1_of),
                      *std::ranges::min_element(runs, {}, f1_of)});
  }
  std::ranges::stable_sort(params, std::ranges::greater(), &ParamExtremes::spread);
  return params;
}

ReportTable table_of_params(const RunGroup& group) {
  ReportTable table;
  table.title = fmt::format("{}: single params", group.title());
  table.caption =
      "The best and the worst value of each param, all others as the pack says; the params that "
      "matter most come first.";
  if (group.baseline() != nullptr)
    table.caption += fmt::format(" '{}' stands where no other value is better, or worse.",
                                 group.baseline()->setting().name);
  table.caption += intervals_sentence(group) + differences_sentence(group);
  const std::vector<std::string> idle = variables_without_effect(group);
  if (!idle.empty())
    table.caption += fmt::format(" Without any effect here: {}.", fmt::join(idle, ", "));
  table.header = {"param", "best",     "macro-F1",   "difference", "p",
                  "worst", "macro-F1", "difference", "p"};
  const std::vector<ParamExtremes> params = extremes_of(group);
  for (const ParamExtremes& param : params) {
    // A table of no rows would say less than one of params that change nothing.
    if (idle.size() < params.size() && std::ranges::find(idle, param.name) != idle.end()) continue;
    table.rows.push_back({param.name});
    for (const MeasuredRun* run : {param.best, param.worst})
      for (const std::string& cell :
           {value_of(*run), f1_cell(*run->mean), difference_cell(*run->mean), p_cell(*run->mean)})
        table.rows.back().push_back(cell);
  }
  return table;
}

std::vector<std::string> line_of(const MeasuredRun& run) {
  return {run.setting().name, f1_cell(*run.mean), difference_cell(*run.mean), p_cell(*run.mean),
          most_changed_class(run)};
}

ReportTable table_of_runs(const RunGroup& group, const std::vector<const MeasuredRun*>& runs) {
  ReportTable table;
  table.title = group.title();
  table.caption = "Each run with its macro-F1 and the class whose F1 changed most." +
                  intervals_sentence(group) + differences_sentence(group);
  table.header = {"run", "macro-F1", "difference", "p", "most changed"};
  for (const MeasuredRun* run : runs) table.rows.push_back(line_of(*run));
  return table;
}

std::vector<const MeasuredRun*> runs_of(const RunGroup& group) {
  std::vector<const MeasuredRun*> runs;
  for (const MeasuredRun& run : group.runs) runs.push_back(&run);
  return runs;
}

/// Runs in which several params were moved together.
ReportTable table_of_best(const RunGroup& group, std::vector<const MeasuredRun*> runs) {
  const std::size_t all = runs.size();
  std::ranges::stable_sort(runs, std::ranges::greater(), f1_of);
  runs.resize(std::min(all, kMostRunsListed));
  ReportTable table = table_of_runs(group, runs);
  if (runs.size() < all)
    table.caption =
        fmt::format("The best {} of {}; results.csv has all.{}{}", runs.size(), counted(all, "run"),
                    intervals_sentence(group), differences_sentence(group));
  return table;
}

std::vector<std::string> line_of_class(const RunGroup& group, const std::string& label) {
  std::vector<std::string> line{label.empty() ? "macro" : label};
  for (const MeasuredRun& run : group.runs) {
    const ResultRow* row = label.empty() ? run.mean : row_of(run, label);
    line.push_back(row == nullptr ? "–" : f1_cell(*row));
    if (run.setting().is_baseline || group.baseline() == nullptr) continue;
    line.push_back(row == nullptr ? "–" : difference_cell(*row));
    line.push_back(row == nullptr ? "–" : p_cell(*row));
  }
  return line;
}

ReportTable table_of_classes(const RunGroup& group) {
  ReportTable table;
  table.title = fmt::format("{}: F1 of each class", group.title());
  table.caption =
      "A line a class, and their mean." + intervals_sentence(group) + differences_sentence(group);
  table.header = {"class"};
  std::vector<std::string> labels;
  for (const MeasuredRun& run : group.runs) {
    table.header.push_back(run.setting().name);
    if (!run.setting().is_baseline && group.baseline() != nullptr) {
      table.header.emplace_back("difference");
      table.header.emplace_back("p");
    }
    for (const ResultRow* row : run.classes)
      if (std::ranges::find(labels, row->label) == labels.end()) labels.push_back(row->label);
  }
  std::ranges::sort(labels);
  labels.emplace_back();
  for (const std::string& label : labels) table.rows.push_back(line_of_class(group, label));
  return table;
}

std::vector<ReportTable> tables_of_sweep(const RunGroup& group) {
  const std::size_t variables = by_variable(group).size();
  if (variables == 1) return {table_of_runs(group, runs_of(group))};
  std::vector<const MeasuredRun*> joint;
  for (const MeasuredRun& run : group.runs)
    if (run.setting().variable.empty() && !run.setting().is_baseline) joint.push_back(&run);
  std::vector<ReportTable> tables;
  if (variables > 0) tables.push_back(table_of_params(group));
  if (!joint.empty()) tables.push_back(table_of_best(group, joint));
  return tables;
}

/// What makes a difference, then the names of what makes none.
std::vector<ReportTable> tables_of_ablations(const RunGroup& group) {
  std::vector<const MeasuredRun*> runs = runs_of(group);
  const auto idle = std::ranges::stable_partition(runs, [&](const MeasuredRun* run) {
    return run->setting().is_baseline || has_effect(group, *run);
  });
  ReportTable without_effect{group.title() + ": without any effect",
                             "What can be taken out here without changing a count of any class.",
                             {"run"},
                             {}};
  for (const MeasuredRun* run : idle) without_effect.rows.push_back({run->setting().name});
  runs.erase(idle.begin(), idle.end());
  std::ranges::stable_sort(runs, [](const MeasuredRun* a, const MeasuredRun* b) {
    const bool is_first = a->setting().is_baseline, is_second = b->setting().is_baseline;
    return is_first != is_second ? is_first : f1_of(a) < f1_of(b);
  });
  std::vector<ReportTable> tables{table_of_runs(group, runs)};
  if (!without_effect.rows.empty()) tables.push_back(std::move(without_effect));
  return tables;
}

}  // namespace

std::vector<ReportTable> tables_of(const RunGroup& group) {
  switch (group.part) {
    case ExperimentPart::sweep:
      return tables_of_sweep(group);
    case ExperimentPart::ablate:
      return tables_of_ablations(group);
    case ExperimentPart::compare:
    case ExperimentPart::learn:
      return {table_of_classes(group)};
    case ExperimentPart::stability:
    case ExperimentPart::learning_curve:
      break;
  }
  return {table_of_runs(group, runs_of(group))};
}

ReportTable table_of_options(const ExperimentResults& results) {
  ReportTable table{"Options", "Each option with its value.", {"option", "value"}, {}};
  for (const auto& [name, value] : results.options) table.rows.push_back({name, value});
  return table;
}

}  // namespace oriel::report
