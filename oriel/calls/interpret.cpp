#include "oriel/interpret.h"

#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

std::vector<Interpretation> interpret(const RuleBase& rules,
                                      std::span<const DescribedBuilding> buildings) {
  std::vector<Interpretation> run;
  run.reserve(buildings.size());
  for (const DescribedBuilding& building : buildings)
    run.push_back(interpret(rules, building.table, building.graph));
  return run;
}

RecordColumns columns_read(const RuleBase& rules) {
  std::vector<std::string> names = {"host"};
  const std::vector<bool> attributes = rules.attributes_read();
  for (std::size_t column = 0; column < attributes.size(); ++column)
    if (attributes[column]) names.push_back(record_name(feature_schema()[column]));
  const std::vector<bool> relations = rules.relations_read();
  for (std::size_t i = 0; i < relations.size(); ++i)
    if (relations[i]) names.push_back("rel_" + relation_schema()[i].name);
  return columns_named(names);
}

std::vector<std::string> columns_lacking(const RuleBase& rules, const RecordColumns& columns) {
  std::vector<std::string> lacking;
  const RecordColumns read = columns_read(rules);
  for (std::size_t field = 0; field < read.size(); ++field)
    if (read[field] && !has_column(columns, field)) lacking.push_back(record_fields()[field]);
  return lacking;
}

std::optional<Issue> lacks_columns(const std::string& file, const RecordColumns& columns,
                                   const RuleBase& rules) {
  constexpr std::size_t kShown = 5;
  const std::vector<std::string> lacking = columns_lacking(rules, columns);
  if (lacking.empty()) return std::nullopt;
  const auto end = lacking.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, lacking.size()));
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E151;
  issue.place.file = file;
  issue.sentence = fmt::format(
      "lacks {} that the pack '{}' reads: {}{}; interpreting it gives other labels than the "
      "buildings have",
      counted(lacking.size(), "column"), printable(rules.name()),
      fmt::join(lacking.begin(), end, ", "), lacking.size() > kShown ? ", ..." : "");
  return issue;
}

LabelDiff diff_labels(std::span<const DescribedBuilding> buildings,
                      std::span<const Interpretation> before, std::span<const Interpretation> after,
                      std::size_t most_examples) {
  LabelDiff diff(most_examples);
  for (std::size_t b = 0; b < buildings.size(); ++b)
    for (std::size_t row = 0; row < before[b].verdicts.size(); ++row) {
      const Verdict& p = before[b].verdicts[row];
      const Verdict& q = after[b].verdicts[row];
      const FeatureTable& table = buildings[b].table;
      diff.add(table.building(), table.id(p.feature), {p.label, p.rule}, {q.label, q.rule});
    }
  return diff;
}

bool RecordLabeller::label(FeatureRecord& record) {
  const auto row = find(record);
  if (!row) return false;
  if (known_ != building_) know_building();
  const FeatureId whole = wholes_[*row];
  set_verdict(record, run_[building_].verdicts[*row], groups_[*row],
              whole.is_valid() ? buildings_[building_].table.id(whole) : "");
  return true;
}

void RecordLabeller::know_building() {
  const FeatureGraph& graph = buildings_[building_].graph;
  std::vector<FeatureId> hosts(buildings_[building_].table.rows());
  for (const auto& [feature, host] : graph.pairs("host")) hosts[feature.index()] = host;
  groups_ = groups_by_feature(run_[building_]);
  wholes_ = wholes_by_feature(run_[building_], hosts);
  known_ = building_;
}

/// The row of the record, not before those that were found so far.
std::optional<std::size_t> RecordLabeller::find(const FeatureRecord& record) {
  std::size_t row = row_;
  for (std::size_t b = building_; b < buildings_.size(); ++b, row = 0) {
    const FeatureTable& table = buildings_[b].table;
    if (table.building() != record.building) continue;
    for (; row < table.rows(); ++row) {
      const FeatureId feature{static_cast<int>(row)};
      if (table.id(feature) != record.id) continue;
      building_ = b;
      row_ = row + 1;
      return row;
    }
  }
  return std::nullopt;
}

}  // namespace oriel
