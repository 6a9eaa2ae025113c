#include "generalise/series/scale_series.h"
#include "io/levels/written_grid.h"
#include "io/records/operation_log.h"
#include "io/writer.h"
#include "oriel/pipeline/series_files.h"
#include "oriel/series.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// The level with the smallest ratio to the scale; of two the finer one.
std::pair<double, std::string> nearest(const std::map<double, std::string>& levels, double scale) {
  return *std::ranges::min_element(
      levels, {}, [&](const auto& level) { return std::abs(std::log(level.first / scale)); });
}

/// Takes the buildings of a level to another scale, record by record. The log has them in the same
/// order.
class LevelMover {
 public:
  LevelMover(const std::string& log, double from, double to) : log_(log), from_(from), to_(to) {
    if (log_.next() != nullptr) lod_ = log_.next()->lod;
  }

  /// Gives the file at the scale to `sink`; false if the level and the log do not fit.
  bool move(const std::string& file, const std::function<void(std::string_view)>& sink) {
    LevelRecords records(file, lod_);
    while (auto record = records.next()) {
      if (!record->value) {
        append(record->issues);
        return false;
      }
      const auto text = moved(*record->value, records);
      if (!text) return false;
      sink(*text);
    }
    if (log_.next() == nullptr) return true;
    Issue issue = building_issue(Severity::error, Code::E120, log_.next()->building,
                                 "is not a level of a series: it has no such building");
    issue.place.file = file;
    issues_.push_back(std::move(issue));
    return false;
  }

  [[nodiscard]] std::vector<Issue> issues() && { return std::move(issues_); }

 private:
  void append(const std::vector<Issue>& issues) {
    issues_.insert(issues_.end(), issues.begin(), issues.end());
  }

  /// The record at the scale.
  std::optional<std::string> moved(const Document& document, LevelRecords& records) {
    const auto operations = operations_of(log_, document);
    auto states = records.states(document, ids_in(operations));
    append(states.issues);
    if (!states.value) return std::nullopt;
    std::vector<LabelledBuilding> labelled;
    WriteOptions options;
    for (LevelState& state : *states.value) {
      const LevelState old = state;
      if (!move(state, operations.at(state.building))) return std::nullopt;
      if (state.facets == old.facets && state.attributes == old.attributes &&
          state.installations == old.installations)
        continue;
      labelled.push_back(rewritten(old, state, document, options));
    }
    options.finer_digits = WrittenGrid(document, *states.value).finer_digits();
    return write_cityjson(document, labelled, options);
  }

  bool move(LevelState& state, const std::vector<SeriesOperation>& operations) {
    if (move_state(state, operations, from_, to_)) return true;
    issues_.push_back(building_issue(Severity::error, Code::G409, state.building,
                                     fmt::format("the level 1:{} and the log do not fit", from_)));
    return false;
  }

  static LabelledBuilding rewritten(const LevelState& old, const LevelState& state,
                                    const Document& document, WriteOptions& options) {
    const auto building = std::ranges::find(document.buildings, state.building, &Building::id);
    LabelledBuilding labelled = labelled_building(state, building->frame);
    for (const auto& [name, value] : old.attributes)
      if (!state.attributes.contains(name)) labelled.dropped_attributes.push_back(name);
    if (state.facets.empty()) options.emptied.push_back(state.building);
    for (const auto& [id, attributes] : old.installations)
      if (!state.installations.contains(id)) options.removed.push_back(id);
    return labelled;
  }

  OperationReader log_;
  double from_, to_;
  std::string lod_;  ///< of the log's operations
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<std::string> files_of_series(const std::string& name) {
  std::vector<std::string> files{log_of_series(name)};
  for (const auto& [scale, file] : levels_of_series(name)) files.push_back(file);
  return files;
}

LevelFromFiles at(const std::string& name, double scale,
                  const std::function<void(std::string_view)>& sink) {
  const std::string log = log_of_series(name);
  LevelFromFiles level;
  std::tie(level.from_scale, level.from_file) = nearest(levels_of_series(name), scale);
  const LogSeal seal = check_log(log);
  if (seal.is_sealed)
    check_hash(seal, log, level.from_scale, level.from_file);
  else
    level.issues.push_back(unsealed(log));
  LevelMover mover(log, level.from_scale, scale);
  level.is_complete = mover.move(level.from_file, sink);
  std::ranges::move(std::move(mover).issues(), std::back_inserter(level.issues));
  return level;
}

}  // namespace oriel
