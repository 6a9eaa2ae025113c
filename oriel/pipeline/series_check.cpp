#include "generalise/series/scale_series.h"
#include "oriel/pipeline/series_files.h"
#include "oriel/series.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// A level that the log names and its file.
struct StoredLevel {
  double scale = 0;
  LevelRecords records;
};

/// Goes through all levels of a series at the same time, record by record, and through its log
/// once.
class SeriesChecker {
 public:
  SeriesChecker(const std::map<double, std::string>& levels, const std::string& log) : log_(log) {
    const std::string lod = log_.next() == nullptr ? "" : log_.next()->lod;
    for (const auto& [scale, file] : levels) {
      levels_.push_back({scale, LevelRecords(file, lod)});
      check_.scales.push_back(scale);
    }
  }

  SeriesCheck check() {
    while (check_record()) continue;
    if (check_.issues.empty() && log_.next() != nullptr)
      refuse(levels_.front(), log_.next()->building, Code::E120,
             "is not a level of a series: it has no such building");
    check_.holds = check_.issues.empty();
    return std::move(check_);
  }

 private:
  /// False after the last record, and after a fault.
  bool check_record() {
    std::vector<Document> documents;
    for (StoredLevel& level : levels_) {
      auto record = level.records.next();
      if (!record) continue;
      if (!record->value) return stop(record->issues);
      documents.push_back(std::move(*record->value));
    }
    if (documents.empty()) return false;
    if (documents.size() != levels_.size()) {
      refuse(levels_.back(), {}, Code::E120, "its levels have different numbers of records");
      return false;
    }
    const OperationsOfRecord operations = operations_of(log_, documents.front());
    return compare(documents, operations);
  }

  bool compare(const std::vector<Document>& documents, const OperationsOfRecord& operations) {
    std::vector<LevelState> before;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      auto states = levels_[i].records.states(documents[i], ids_in(operations));
      if (!states.value) return stop(states.issues);
      for (std::size_t k = 0; i > 0 && k < before.size(); ++k)
        if (!leads(i, before[k], (*states.value)[k], operations)) return false;
      before = std::move(*states.value);
    }
    check_.buildings += operations.size();
    for (const auto& [id, list] : operations) check_.operations += list.size();
    return true;
  }

  /// True if the operations lead from the level before level i to it, and back.
  bool leads(std::size_t i, const LevelState& fine, const LevelState& coarse,
             const OperationsOfRecord& operations) {
    const auto& list = operations.at(fine.building);
    const double from = levels_[i - 1].scale, to = levels_[i].scale;
    LevelState down = fine, up = coarse;
    if (move_state(down, list, from, to) && down == coarse && move_state(up, list, to, from) &&
        up == fine)
      return true;
    refuse(levels_[i], fine.building, Code::G409,
           fmt::format("the log does not lead from the level 1:{} to 1:{} and back", from, to));
    return false;
  }

  void refuse(const StoredLevel& level, const std::string& building, Code code,
              std::string sentence) {
    Issue issue = building_issue(Severity::error, code, building, std::move(sentence));
    issue.place.file = level.records.file();
    check_.issues.push_back(std::move(issue));
  }

  bool stop(const std::vector<Issue>& issues) {
    check_.issues.insert(check_.issues.end(), issues.begin(), issues.end());
    return false;
  }

  OperationReader log_;
  std::deque<StoredLevel> levels_;
  SeriesCheck check_;
};

/// Every level that the log names is there; that a level is in it, check_hash() finds.
void check_all_there(const LogSeal& seal, const std::string& log,
                     const std::map<double, std::string>& levels) {
  for (const auto& [scale, hash] : seal.levels) {
    const bool is_there = std::ranges::any_of(
        levels, [&](const auto& level) { return fmt::format("{}", level.first) == scale; });
    if (is_there) continue;
    Issue issue;
    issue.code = Code::E132;
    issue.sentence = fmt::format("was written with a level 1:{}, whose file is gone", scale);
    issue.place.file = log;
    throw InputError(std::move(issue));
  }
}

}  // namespace

SeriesCheck check_series(const std::string& name) {
  const std::string log = log_of_series(name);
  const auto levels = levels_of_series(name);
  const LogSeal seal = check_log(log);
  if (seal.is_sealed) {
    for (const auto& [scale, file] : levels) check_hash(seal, log, scale, file);
    check_all_there(seal, log, levels);
  }
  SeriesCheck check = SeriesChecker(levels, log).check();
  if (!seal.is_sealed) check.issues.push_back(unsealed(log));
  return check;
}

}  // namespace oriel
