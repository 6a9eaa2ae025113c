#include "experiments/file_patterns.h"

#include <algorithm>
#include <filesystem>
#include <glob.h>
#include <set>

#include <fmt/format.h>

namespace oriel {

namespace {

namespace fs = std::filesystem;

/// So that glob() takes every character as it is.
std::string without_wildcards(const std::string& path) {
  std::string escaped;
  for (const char c : path) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::vector<std::string> matches_of(const std::string& pattern) {
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    for (std::size_t i = 0; i < found.gl_pathc; ++i) paths.emplace_back(found.gl_pathv[i]);
  ::globfree(&found);
  std::ranges::sort(paths);
  return paths;
}

bool is_regular(const std::string& path) {
  std::error_code problem;
  return fs::is_regular_file(path, problem);
}

}  // namespace

std::vector<std::string> files_of(const std::vector<FilePattern>& patterns,
                                  const std::string& plan_file, std::vector<Issue>& issues) {
  const std::string folder = fs::path(plan_file).parent_path().string();
  std::vector<std::string> files;
  std::set<std::string> known;
  for (const FilePattern& pattern : patterns) {
    const bool is_absolute = fs::path(pattern.text).is_absolute() || folder.empty();
    const auto found =
        matches_of(is_absolute ? pattern.text : without_wildcards(folder) + "/" + pattern.text);
    std::size_t regular = 0;
    for (const std::string& path : found) {
      if (!is_regular(path)) continue;
      ++regular;
      if (known.insert(path).second) files.push_back(path);
    }
    if (regular > 0) continue;
    const bool is_folder = !found.empty() && fs::is_directory(found.front());
    issues.push_back(pattern.spot.issue(
        Severity::error, Code::R280,
        is_folder ? fmt::format("'{}' is a folder; write a pattern for its files, such as '{}/*'",
                                pattern.text, pattern.text)
                  : fmt::format("'{}' matches no file in {}", pattern.text,
                                folder.empty() ? "this folder" : "the folder '" + folder + "'")));
  }
  return files;
}

std::string path_in_plan(const std::string& path, const std::string& plan_file) {
  const std::string folder = fs::path(plan_file).parent_path().string();
  if (folder.empty() || !path.starts_with(folder + "/")) return path;
  return path.substr(folder.size() + 1);
}

}  // namespace oriel
