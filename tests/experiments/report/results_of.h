#pragma once

#include "experiments/results/results.h"

#include <string>
#include <vector>

namespace oriel::test {

/// The rows of a run of two classes and their mean.
inline std::vector<ResultRow> rows_of_run(ExperimentPart part, const std::string& set,
                                          const RunSetting& setting, double door, double window) {
  std::vector<ResultRow> rows(3);
  const double f1[] = {door, window, (door + window) / 2};
  const char* const labels[] = {"door", "window", ""};
  for (std::size_t i = 0; i < 3; ++i) {
    ResultRow& row = rows[i];
    row.part = part;
    row.set = set;
    row.pack = "residential";
    row.setting = setting;
    row.label = labels[i];
    row.counts = {8, static_cast<std::size_t>(100 * (1 - f1[i])), 2};
    row.precision = f1[i];
    row.recall = f1[i];
    row.f1 = f1[i];
    row.f1_interval = {f1[i] - 0.05, f1[i] + 0.05};
    if (!setting.is_baseline)
      row.difference = PairedDifference{f1[i] - 0.9, {f1[i] - 0.93, f1[i] - 0.88}, 0.02};
  }
  return rows;
}

inline void add_run(ExperimentResults& results, ExperimentPart part, const RunSetting& setting,
                    double door, double window) {
  for (const ResultRow& row : rows_of_run(part, "houses", setting, door, window))
    results.rows.push_back(row);
}

/// A run of each kind; names have what the forms must escape.
inline ExperimentResults some_results() {
  ExperimentResults results;
  results.name = "tried & <true>";
  results.program = "oriel 0.1.0";
  results.options = {{"seed", "1"}};
  results.inputs = {{"models", "houses.city.jsonl", std::string(64, '0')}};
  const RunSetting base{"as the pack says", "", {}, "", true};
  add_run(results, ExperimentPart::sweep, base, 0.9, 0.9);
  for (const double value : {0.6, 0.9, 1.1})
    add_run(
        results, ExperimentPart::sweep,
        {"parapet = " + std::to_string(value).substr(0, 3) + " m", "parapet", value, "m", false},
        0.9 - value / 10, 0.95);
  add_run(results, ExperimentPart::sweep, {"step = 1 m", "step", 1, "m", false}, 0.7, 0.9);
  add_run(results, ExperimentPart::ablate, base, 0.9, 0.9);
  add_run(results, ExperimentPart::ablate, {"without rule door.on_ground", "", {}, "", false}, 0.2,
          0.9);
  add_run(results, ExperimentPart::ablate, {"without 'width < 1 m | 50 %'", "", {}, "", false}, 0.8,
          0.9);
  add_run(results, ExperimentPart::compare, {"residential", "", {}, "", true}, 0.9, 0.9);
  add_run(results, ExperimentPart::compare, {"mine_1.yaml", "", {}, "", false}, 0.95, 0.9);
  results.tables.push_back({"Learnt", "Params.", {"param", "to"}, {{"parapet", "0.8 m"}}});
  return results;
}

}  // namespace oriel::test
