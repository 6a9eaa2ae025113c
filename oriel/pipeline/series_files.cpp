#include "oriel/pipeline/series_files.h"

#include "io/files/partial_files.h"
#include "io/levels/level_file.h"

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
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

ReadOptions reading_levels(const std::string& lod) {
  ReadOptions options;
  options.joins_installations = false;
  options.keeps_emptied = true;
  if (!lod.empty()) options.lod = lod;
  return options;
}

}  // namespace

std::string log_of_series(const std::string& name) { return name + ".oplog.jsonl"; }

std::map<double, std::string> levels_of_series(const std::string& name) {
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

void check_hash(const LogSeal& seal, const std::string& log, double scale,
                const std::string& level) {
  const auto written = seal.levels.find(fmt::format("{}", scale));
  if (written == seal.levels.end())
    throw unusable(level, Code::E132, fmt::format("is not a level of the series of {}", log));
  constexpr auto kWhole = std::numeric_limits<std::uint64_t>::max();
  if (PartialFiles::mark_of(level, kWhole).sha256 != written->second)
    throw unusable(level, Code::E132,
                   fmt::format("is not the file that was written with {}: its hash differs", log));
}

Issue unsealed(const std::string& log) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E133;
  issue.sentence = "has no checks: a change to the log or its levels would not be noticed";
  issue.place.file = log;
  return issue;
}

OperationsOfRecord operations_of(OperationReader& log, const Document& document) {
  std::set<std::string> here;
  for (const Building& building : document.buildings) here.insert(building.id);
  OperationsOfRecord operations;
  while (log.next() != nullptr && here.contains(log.next()->building)) {
    SeriesOperation operation = log.take();
    operations[operation.building].push_back(std::move(operation));
  }
  return operations;
}

std::vector<std::string> ids_in(const OperationsOfRecord& operations) {
  std::vector<std::string> ids;
  for (const auto& [id, list] : operations) ids.push_back(id);
  return ids;
}

LevelRecords::LevelRecords(std::string file, std::string lod)
    : file_(std::move(file)), lod_(std::move(lod)), reader_(file_, reading_levels(lod_)) {}

Checked<std::vector<LevelState>> LevelRecords::states(const Document& document,
                                                      const std::vector<std::string>& ids) {
  if (reader_.format() != Format::cityjson_seq)
    return read_level(text_of(file_), document.name, ids, {}, lod_);
  const std::string_view line = source_line(document);
  auto states = read_level(line, document.name, ids, header_, lod_);
  if (header_.empty()) header_ = line;
  return states;
}

}  // namespace oriel
