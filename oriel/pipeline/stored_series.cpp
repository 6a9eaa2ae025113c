#include "generalise/series/scale_series.h"
#include "kernel/io/files/partial_files.h"
#include "kernel/io/levels/level_file.h"
#include "kernel/io/levels/written_grid.h"
#include "kernel/io/reader.h"
#include "kernel/io/records/log_seal.h"
#include "kernel/io/records/operation_log.h"
#include "kernel/io/writer.h"
#include "oriel/series.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

namespace fs = std::filesystem;

InputError unusable(const std::string& file, Code code, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = file;
  return InputError(std::move(issue));
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw unusable(path, Code::E101, "cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The number N of a file that is called START then N then ENDING.
std::optional<double> scale_in(const std::string& file, const std::string& start,
                               const std::string& ending) {
  if (!file.starts_with(start) || !file.ends_with(ending)) return std::nullopt;
  const char* const last = file.data() + file.size() - ending.size();
  double scale = 0;
  const auto result = std::from_chars(file.data() + start.size(), last, scale);
  if (result.ec != std::errc() || result.ptr != last || !(scale >= 1)) return std::nullopt;
  return scale;
}

/// The files NAME.1-N.city.json, or of a series of streams NAME.1-N.city.jsonl, by N.
std::map<double, std::string> levels_of(const std::string& name) {
  const fs::path path(name);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string start = path.filename().string() + ".1-";
  std::map<double, std::string> levels;
  std::set<std::string> endings;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    for (const char* ending : {".city.json", ".city.jsonl"})
      if (const auto scale = scale_in(file, start, ending)) {
        levels.emplace(*scale, entry.path().string());
        endings.insert(ending);
      }
  }
  if (levels.empty())
    throw unusable(name, Code::E101, "has no levels: there is no " + name + ".1-N.city.json");
  if (endings.size() > 1)
    throw unusable(name, Code::G409, "has the levels of two series, .city.json and .city.jsonl");
  return levels;
}

/// The level with the smallest ratio to the scale; of two the finer one.
std::pair<double, std::string> nearest(const std::map<double, std::string>& levels, double scale) {
  return *std::ranges::min_element(
      levels, {}, [&](const auto& level) { return std::abs(std::log(level.first / scale)); });
}

/// Log and level are what was written together; of logs without checks a warning says that nobody
/// knows. Throws InputError E132.
std::vector<Issue> check_seal(const std::string& log, double scale, const std::string& level) {
  const LogSeal seal = check_log(log);
  if (!seal.is_sealed) {
    Issue issue;
    issue.severity = Severity::warning;
    issue.code = Code::E133;
    issue.sentence = "has no checks: a change to the log or its levels would not be noticed";
    issue.place.file = log;
    return {issue};
  }
  const auto written = seal.levels.find(fmt::format("{}", scale));
  if (written == seal.levels.end())
    throw unusable(level, Code::E132, fmt::format("is not a level of the series of {}", log));
  constexpr auto kWhole = std::numeric_limits<std::uint64_t>::max();
  if (PartialFiles::mark_of(level, kWhole).sha256 != written->second)
    throw unusable(level, Code::E132,
                   fmt::format("is not the file that was written with {}: its hash differs", log));
  return {};
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
    ReadOptions options;
    options.joins_installations = false;
    if (!lod_.empty()) options.lod = lod_;
    Reader reader(file, options);
    while (auto record = reader.next()) {
      if (!record->value) {
        append(record->issues);
        return false;
      }
      const bool is_stream = reader.format() == Format::cityjson_seq;
      const auto text = moved(*record->value, is_stream ? "" : text_of(file));
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

  /// The record at the scale; `text` is what it was read from, empty: a line of a stream.
  std::optional<std::string> moved(const Document& document, const std::string& text) {
    const std::string_view line = text.empty() ? source_line(document) : std::string_view(text);
    const auto operations = operations_of(document);
    std::vector<std::string> ids;
    for (const auto& [id, list] : operations) ids.push_back(id);
    auto states = read_level(line, document.name, ids, header_, lod_);
    append(states.issues);
    if (!states.value) return std::nullopt;
    if (text.empty() && header_.empty()) header_ = line;
    std::vector<LabelledBuilding> labelled;
    WriteOptions options;
    for (LevelState& state : *states.value) {
      const LevelState old = state;
      if (!move(state, operations.at(state.building))) return std::nullopt;
      labelled.push_back(rewritten(old, state, document, options));
    }
    options.finer_digits = WrittenGrid(document, *states.value).finer_digits();
    return write_cityjson(document, labelled, options);
  }

  /// Those that come next in the log, by building.
  std::map<std::string, std::vector<SeriesOperation>> operations_of(const Document& document) {
    std::set<std::string> here;
    for (const Building& building : document.buildings) here.insert(building.id);
    std::map<std::string, std::vector<SeriesOperation>> operations;
    while (log_.next() != nullptr && here.contains(log_.next()->building)) {
      SeriesOperation operation = log_.take();
      operations[operation.building].push_back(std::move(operation));
    }
    return operations;
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
    for (const auto& [id, attributes] : old.installations)
      if (!state.installations.contains(id)) options.removed.push_back(id);
    return labelled;
  }

  OperationReader log_;
  double from_, to_;
  std::string lod_;     ///< of the log's operations
  std::string header_;  ///< of a stream
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<std::string> files_of_series(const std::string& name) {
  std::vector<std::string> files{name + ".oplog.jsonl"};
  for (const auto& [scale, file] : levels_of(name)) files.push_back(file);
  return files;
}

LevelFromFiles at(const std::string& name, double scale,
                  const std::function<void(std::string_view)>& sink) {
  const std::string log = name + ".oplog.jsonl";
  LevelFromFiles level;
  std::tie(level.from_scale, level.from_file) = nearest(levels_of(name), scale);
  level.issues = check_seal(log, level.from_scale, level.from_file);
  LevelMover mover(log, level.from_scale, scale);
  level.is_complete = mover.move(level.from_file, sink);
  std::ranges::move(std::move(mover).issues(), std::back_inserter(level.issues));
  return level;
}

}  // namespace oriel
