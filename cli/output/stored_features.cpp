#include "cli/output/stored_features.h"

#include "interpret/labelling/interpret.h"
#include "kernel/io/records/feature_records.h"
#include "kernel/io/records/feature_tables.h"

#include <iterator>
#include <map>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// The verdicts of a run in the order of the records, each with the names of its feature.
class Verdicts {
 public:
  Verdicts(const std::vector<DescribedBuilding>& buildings, const std::vector<Interpretation>& run)
      : buildings_(buildings), run_(run) {}

  /// Puts into a record the verdict of its feature, after those that were found so far; false if
  /// there is none.
  bool set(FeatureRecord& record) {
    const auto row = find(record);
    if (!row) return false;
    if (groups_of_ != building_) groups_ = groups_by_feature(run_[building_]);
    groups_of_ = building_;
    set_verdict(record, run_[building_].verdicts[*row], groups_[*row]);
    return true;
  }

 private:
  std::optional<std::size_t> find(const FeatureRecord& record) {
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

  const std::vector<DescribedBuilding>& buildings_;
  const std::vector<Interpretation>& run_;
  std::size_t building_ = 0;
  std::size_t row_ = 0;
  /// The groups of the features of that building.
  std::optional<std::size_t> groups_of_;
  std::vector<std::vector<std::string>> groups_;
};

}  // namespace

StoredFeatures::StoredFeatures(std::vector<std::string> files, Report& report)
    : files_(std::move(files)), report_(report) {
  for (const std::string& file : files_) {
    auto tables = read_feature_tables(file);
    report_.add(tables.issues);
    if (has_errors(tables.issues))
      code_ = graver(code_, tables.value ? ExitCode::set_aside : ExitCode::input);
    if (tables.value)
      buildings_.insert(buildings_.end(), std::make_move_iterator(tables.value->begin()),
                        std::make_move_iterator(tables.value->end()));
  }
}

std::vector<Interpretation> StoredFeatures::interpret(const RuleBase& rules, int jobs) const {
  std::vector<Interpretation> run(buildings_.size());
  tbb::task_arena arena(jobs);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, buildings_.size(), [&](std::size_t i) {
      run[i] = oriel::interpret(rules, buildings_[i].table, buildings_[i].graph);
    });
  });
  for (const Interpretation& interpretation : run) report_.add(interpretation.issues);
  return run;
}

std::string StoredFeatures::listing(const std::vector<Interpretation>& run) {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (const Interpretation& interpretation : run)
    for (const Verdict& verdict : interpretation.verdicts) ++counts[{verdict.label, verdict.rule}];
  std::vector<std::vector<std::string>> rows{{"label", "rule", "features"}};
  for (const auto& [naming, count] : counts)
    rows.push_back({naming.first.empty() ? "unknown" : naming.first,
                    naming.second.empty() ? "-" : naming.second, fmt::format("{}", count)});
  return table(rows);
}

LabelDiff StoredFeatures::compare(const std::vector<Interpretation>& before,
                                  const std::vector<Interpretation>& after,
                                  std::size_t most_examples) const {
  LabelDiff diff(most_examples);
  for (std::size_t b = 0; b < buildings_.size(); ++b)
    for (std::size_t row = 0; row < before[b].verdicts.size(); ++row) {
      const Verdict& p = before[b].verdicts[row];
      const Verdict& q = after[b].verdicts[row];
      const FeatureTable& table = buildings_[b].table;
      diff.add(table.building(), table.id(p.feature), {p.label, p.rule}, {q.label, q.rule});
    }
  return diff;
}

void StoredFeatures::write(const std::string& path, const std::vector<Interpretation>& run) {
  FeatureRecordWriter writer(path);
  Verdicts verdicts(buildings_, run);
  for (const std::string& file : files_) {
    const auto issues = visit_feature_records(file, [&](FeatureRecord record) {
      if (!verdicts.set(record)) return;
      writer.append({std::move(record)});
    });
    // Boxes and polygons, without which the tables could be read, are not reported yet.
    if (has_errors(issues) && code_ == ExitCode::clean) {
      report_.add(issues);
      code_ = ExitCode::set_aside;
    }
  }
  writer.commit();
}

}  // namespace oriel::cli
