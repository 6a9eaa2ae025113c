#include "cli/terminal/file_advice.h"

#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

/// What files are that people take for buildings, by the end of their names.
struct OtherFile {
  std::string_view ending;
  std::string_view advice;
};

constexpr OtherFile kOtherFiles[] = {
    {".gz", "the file is compressed: unpack it first, with gunzip"},
    {".zip", "the file is compressed: unpack it first, with unzip"},
    {".bz2", "the file is compressed: unpack it first, with bunzip2"},
    {".xz", "the file is compressed: unpack it first, with unxz"},
    {".zst", "the file is compressed: unpack it first, with unzstd"},
    {".yaml", "a rule pack is named by --rules"},
    {".yml", "a rule pack is named by --rules"},
    {".csv", "records of features are read by interpret, score and diff"},
    {".ifc", "IFC is not read: convert the file to CityJSON or CityGML first"},
    {".dxf", "DXF is not read: convert the file to CityJSON or OBJ first"},
};

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    names.push_back(entry->path().filename().string());
  std::ranges::sort(names);
  return names;
}

/// The file that stands where the path has a folder; empty: there is none.
std::string file_for_folder(const std::string& path) {
  std::error_code error;
  fs::path folder = folder_of(path);
  while (folder.has_relative_path() && !is_there(folder)) folder = folder.parent_path();
  return fs::is_regular_file(folder, error) ? folder.string() : "";
}

std::string missing_folder(const std::string& path) {
  const fs::path folder = folder_of(path);
  return is_there(folder) ? "" : fmt::format("there is no folder '{}'", printable(folder.string()));
}

std::string advice_on_missing(const std::string& path) {
  const std::string folder = missing_folder(path);
  if (!folder.empty()) return folder;
  const std::string name = fs::path(path).filename().string();
  const std::string near = nearest(name, names_in(folder_of(path)));
  return near.empty() ? "expected an existing file or folder"
                      : fmt::format("did you mean '{}'?", printable(near));
}

std::string advice_on(const Issue& issue) {
  const std::string& path = issue.place.file;
  std::error_code error;
  if (path.empty()) return {};
  if (issue.code == Code::E101 || issue.code == Code::E601)
    if (const std::string file = file_for_folder(path); !file.empty())
      return fmt::format("'{}' is a file, not a folder", printable(file));
  if (issue.code == Code::E101) return is_there(path) ? "" : advice_on_missing(path);
  if (issue.code == Code::E601) {
    if (fs::is_directory(path, error)) return "name a file in that folder";
    const std::string folder = missing_folder(path);
    return folder.empty() ? "" : folder + ": make it first";
  }
  if (issue.code != Code::E106) return {};
  const auto* const other = std::ranges::find_if(
      kOtherFiles, [&](const OtherFile& one) { return path.ends_with(one.ending); });
  return other == std::end(kOtherFiles) ? std::string() : std::string(other->advice);
}

}  // namespace

Issue with_file_advice(Issue issue) {
  const std::string advice = advice_on(issue);
  if (!advice.empty()) issue.sentence += "; " + advice;
  return issue;
}

}  // namespace oriel::cli
