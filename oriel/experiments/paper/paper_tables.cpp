#include "oriel/experiments/paper/paper_tables.h"

#include "kernel/io/reader.h"
#include "oriel/experiments/paper/count.h"
#include "oriel/segment.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A building, and what came of it.
struct CountedBuilding {
  Building building;
  std::optional<PaperCount> count;
  std::vector<Issue> issues;
};

void count_building(CountedBuilding& counted, const PipelineOptions& options) {
  PipelineResult result = segment(counted.building, options);
  counted.issues = std::move(result.issues);
  if (result.is_done() && !result.is_open)
    counted.count = count_as_paper(counted.building, result, options);
}

Issue why_not_counted(const CountedBuilding& counted) {
  const auto why = std::ranges::find(counted.issues, Severity::error, &Issue::severity);
  const Issue known = why == counted.issues.end() ? Issue() : *why;
  return building_issue(Severity::warning, known.code, counted.building.id,
                        "is no solid, so that nothing is counted" +
                            (known.sentence.empty() ? std::string() : ": " + known.sentence));
}

ReportTable table_of_counts(CountTable rows, std::string title, std::string caption) {
  ReportTable table{std::move(title), std::move(caption), std::move(rows.front()), {}};
  table.rows.assign(std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end()));
  return table;
}

void add_tables(const CountedBuilding& counted, std::vector<ReportTable>& tables) {
  const std::string& id = counted.building.id;
  tables.push_back(table_of_counts(
      first_recursion(*counted.count), fmt::format("Combinations of planes of {}", id),
      fmt::format(
          "The body has {} planes. Combinations of 1, 2, 3 and 4 of them, and how many the "
          "first recursion tests: with the heuristics of Thiemann and Sester (2004), without "
          "each of them, and without all.",
          counted.count->planes)));
  tables.push_back(table_of_counts(all_recursions(*counted.count),
                                   fmt::format("All recursions of {}", id),
                                   "What the paper's algorithm tests and evaluates until nothing "
                                   "can be cut, and what oriel does."));
}

}  // namespace

std::vector<ReportTable> paper_tables(const std::vector<HashedFile>& files,
                                      const PipelineOptions& options, const ForEachShare& for_each,
                                      std::vector<Issue>& issues) {
  std::vector<CountedBuilding> all;
  for (const HashedFile& file : files) {
    ReadOptions reading;
    if (!options.lod.empty()) reading.lod = options.lod;
    Reader reader(file.path, reading);
    while (auto record = reader.next()) {
      std::ranges::copy_if(record->issues, std::back_inserter(issues),
                           [](const Issue& issue) { return issue.severity == Severity::error; });
      if (!record->value) continue;
      for (Building& building : record->value->buildings)
        all.push_back({std::move(building), {}, {}});
    }
  }
  for_each(all.size(), [&](std::size_t i) { count_building(all[i], options); });
  std::vector<ReportTable> tables;
  for (const CountedBuilding& counted : all) {
    if (counted.count)
      add_tables(counted, tables);
    else
      issues.push_back(why_not_counted(counted));
  }
  return tables;
}

}  // namespace oriel
