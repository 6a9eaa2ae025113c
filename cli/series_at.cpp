#include "cli/series.h"
#include "generalise/scale_series.h"
#include "kernel/io/level_file.h"
#include "kernel/io/operation_log.h"
#include "kernel/io/output_file.h"
#include "kernel/io/reader.h"
#include "kernel/io/writer.h"
#include "kernel/io/written_grid.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

InputError missing(const std::string& file, std::string sentence) {
  Issue issue;
  issue.code = "E101";
  issue.sentence = std::move(sentence);
  issue.place.file = file;
  return InputError(std::move(issue));
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw missing(path, "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The files NAME.1-N.city.json, by N.
std::map<double, std::string> levels_of(const std::string& name) {
  const fs::path path(name);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string start = path.filename().string() + ".1-";
  const std::string ending = ".city.json";
  std::map<double, std::string> levels;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(start) || !file.ends_with(ending)) continue;
    const char* const last = file.data() + file.size() - ending.size();
    double scale = 0;
    const auto result = std::from_chars(file.data() + start.size(), last, scale);
    if (result.ec == std::errc() && result.ptr == last && scale >= 1)
      levels.emplace(scale, entry.path().string());
  }
  if (levels.empty()) throw missing(name, "has no levels: there is no " + name + ".1-N.city.json");
  return levels;
}

/// The level with the smallest ratio to the scale; of two the finer one.
std::pair<double, std::string> nearest(const std::map<double, std::string>& levels, double scale) {
  return *std::ranges::min_element(
      levels, {}, [&](const auto& level) { return std::abs(std::log(level.first / scale)); });
}

/// Takes the buildings of a level to another scale.
class LevelMover {
 public:
  LevelMover(std::vector<SeriesOperation> operations, double from, double to)
      : from_(from), to_(to) {
    for (SeriesOperation& operation : operations)
      by_building_[operation.building].push_back(std::move(operation));
  }

  /// The text of the file at the scale, or nothing if the level and the log do not fit.
  std::optional<std::string> moved(const std::string& file, Report& report) {
    Reader reader(file);
    auto record = reader.next();
    if (!record || !record->value) {
      if (record) report.tell(record->issues);
      return std::nullopt;
    }
    const Document& document = *record->value;
    std::vector<std::string> ids;
    for (const auto& [id, operations] : by_building_) ids.push_back(id);
    auto states = read_level(text_of(file), file, ids);
    report.tell(states.issues);
    if (!states.value) return std::nullopt;
    std::vector<LabelledBuilding> labelled;
    WriteOptions options;
    for (LevelState& state : *states.value) {
      const LevelState old = state;
      if (!move(state, report)) return std::nullopt;
      labelled.push_back(rewritten(old, state, document, options));
    }
    options.finer_digits = WrittenGrid(document, *states.value).finer_digits();
    return write_cityjson(document, labelled, options);
  }

 private:
  bool move(LevelState& state, Report& report) const {
    if (move_state(state, by_building_.at(state.building), from_, to_)) return true;
    report.tell(building_issue(Severity::error, "G409", state.building,
                               fmt::format("the level 1:{} and the log do not fit", from_)));
    return false;
  }

  static LabelledBuilding rewritten(const LevelState& old, const LevelState& state,
                                    const Document& document, WriteOptions& options) {
    const auto building = std::ranges::find(document.buildings, state.building, &Building::id);
    LabelledBuilding labelled = labelled_building(state, building->frame);
    for (const auto& [name, value] : old.attributes)
      if (!state.attributes.contains(name)) labelled.dropped_attributes.push_back(name);
    for (const auto& [id, attributes] : old.installations)
      if (!state.installations.contains(id)) options.removed.push_back(id);
    return labelled;
  }

  std::map<std::string, std::vector<SeriesOperation>> by_building_;
  double from_, to_;
};

}  // namespace

ExitCode write_level_at(const std::string& name, double scale, const std::string& out,
                        Report& report) {
  const std::string log = name + ".oplog.jsonl";
  auto operations = read_operations(text_of(log), log);
  report.tell(operations.issues);
  if (!operations.value) return ExitCode::input;
  const auto [from, file] = nearest(levels_of(name), scale);
  const auto text = LevelMover(std::move(*operations.value), from, scale).moved(file, report);
  if (!text) return ExitCode::input;
  write_file(out, *text);
  std::fputs(fmt::format("1:{} from {}\n", scale, file).c_str(), stderr);
  return ExitCode::clean;
}

}  // namespace oriel::cli
