#include "cli/batch/inputs/input_files.h"

#include "cli/batch/run_options.h"
#include "cli/terminal/logging.h"
#include "io/files/format.h"
#include "io/files/partial_files.h"
#include "kernel/base/issue.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

/// Where a JSON file says what it is, whatever the order of its members.
constexpr std::size_t kTellingBytes = 1 << 16;

bool holds_cityjson(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(kTellingBytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text.find("\"CityJSON") != std::string::npos ||
         text.find("\"CityObjects\"") != std::string::npos;
}

bool is_of_buildings(const std::string& path, const std::string& from) {
  const auto format = format_of(path);
  if (!format || !is_readable(*format)) return false;
  if (!from.empty() && format != parse_format(from)) return false;
  const bool is_json = *format == Format::cityjson || *format == Format::cityjson_seq;
  const bool says_city = path.ends_with(".city.json") || path.ends_with(".city.jsonl");
  return !is_json || says_city || holds_cityjson(path);
}

/// One text for all names of a file.
std::string identity_of(const std::string& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode))
    return fmt::format("{} {}", found.st_dev, found.st_ino);
  return detail::resolved(path);
}

Issue about_input(const std::string& input, Severity severity, Code code, std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = code;
  issue.place.file = input;
  issue.sentence = std::move(sentence);
  return issue;
}

Issue given_again(const std::string& first, const std::vector<std::string>& others) {
  std::vector<std::string> spellings = others;
  std::erase(spellings, first);
  const std::size_t times = others.size() + 1;
  return about_input(
      first, Severity::warning, Code::E602,
      fmt::format(
          "is given {}{}; it is read once", times == 2 ? "twice" : fmt::format("{} times", times),
          spellings.empty() ? "" : fmt::format(", also as {}", fmt::join(spellings, ", "))));
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return path != "-" && fs::is_directory(path, error);
}

std::size_t count_files(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) count += entry.is_regular_file() ? 1 : 0;
  return count;
}

std::vector<std::string> expanded(const std::vector<std::string>& inputs, const std::string& from,
                                  Report& report) {
  std::vector<std::string> all;
  for (const std::string& input : inputs) {
    const std::vector<std::string> files =
        is_folder(input) ? files_in(input, from) : std::vector<std::string>();
    if (files.empty()) {
      all.push_back(input);
      continue;
    }
    all.insert(all.end(), files.begin(), files.end());
    const std::size_t others = count_files(input) - files.size();
    if (others > 0)
      report.add(
          about_input(input, Severity::note, Code::E106,
                      fmt::format("{} in the folder {} no buildings by name or content",
                                  counted(others, "file"), agreeing(others, "holds", "hold"))));
  }
  return all;
}

}  // namespace

std::vector<std::string> files_in(const std::string& folder, const std::string& from) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->is_regular_file(error) && is_of_buildings(entry->path().string(), from))
      files.push_back(entry->path().string());
  std::ranges::sort(files);
  return files;
}

void read_once(std::vector<std::string>& files, Report& report) {
  std::vector<std::string> kept;
  std::map<std::string, std::size_t> place_of;
  std::map<std::size_t, std::vector<std::string>> again;  // by the place in `kept`
  for (const std::string& file : files) {
    if (file != "-") {
      const auto [place, is_new] = place_of.try_emplace(identity_of(file), kept.size());
      if (!is_new) again[place->second].push_back(file);
      if (!is_new) continue;
    }
    kept.push_back(file);
  }
  for (const auto& [place, others] : again) report.add(given_again(kept[place], others));
  files = std::move(kept);
}

void settle_inputs(RunOptions& options, Report& report) {
  options.inputs = expanded(options.inputs, options.from, report);
  read_once(options.inputs, report);
}

std::vector<std::string> truth_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  for (const std::string& path : named) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const auto before = static_cast<std::ptrdiff_t>(files.size());
    for (const auto& entry : fs::directory_iterator(path))
      if (const std::string file = entry.path().string();
          file.ends_with(".truth.json") || file.ends_with(".truth.jsonl"))
        files.push_back(file);
    std::ranges::sort(files.begin() + before, files.end());
    if (std::ssize(files) == before)
      throw InputError(about_input(path, Severity::error, Code::E101,
                                   "the folder has no *.truth.json or *.truth.jsonl"));
  }
  return files;
}

void refuse_folder(const std::string& input) {
  if (!is_folder(input)) return;
  throw InputError(about_input(
      input, Severity::error, Code::E106,
      "the folder has no file of buildings (folders within it are not read); expected files in "
      ".city.json, .city.jsonl, .gml, .obj, .off, .ply or .stl"));
}

}  // namespace oriel::cli
