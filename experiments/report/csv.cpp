#include "experiments/report/forms.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/json_text.h"

#include <cmath>

namespace oriel::report {

namespace {

std::string number_cell(double value) { return std::isnan(value) ? "" : shortest(value); }

std::string number_cell(const std::optional<double>& value) {
  return value ? number_cell(*value) : "";
}

std::vector<std::string> cells_of(const ResultRow& row) {
  const auto& interval = row.f1_interval;
  const auto& difference = row.difference;
  return {to_string(row.part),
          row.set,
          row.pack,
          row.setting.name,
          row.setting.variable,
          number_cell(row.setting.value),
          row.setting.unit,
          row.setting.is_baseline ? "yes" : "no",
          row.label.empty() ? "macro" : row.label,
          std::to_string(row.counts.true_positives),
          std::to_string(row.counts.false_positives),
          std::to_string(row.counts.false_negatives),
          number_cell(row.precision),
          number_cell(row.recall),
          number_cell(row.f1),
          interval ? number_cell(interval->low) : "",
          interval ? number_cell(interval->high) : "",
          difference ? number_cell(difference->f1) : "",
          difference ? number_cell(difference->interval.low) : "",
          difference ? number_cell(difference->interval.high) : "",
          difference ? number_cell(difference->p) : ""};
}

}  // namespace

std::string csv_of(const std::vector<ResultRow>& rows) {
  std::string text =
      "part,set,pack,setting,variable,value,unit,baseline,class,true_positives,false_positives,"
      "false_negatives,precision,recall,f1,f1_low,f1_high,difference,difference_low,"
      "difference_high,p\n";
  for (const ResultRow& row : rows) append_csv_line(text, cells_of(row));
  return text;
}

}  // namespace oriel::report
