#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::test {

/// The folder of shared data: $ORIEL_SHARED, else ../shared beside the project; nothing if it is
/// not there.
inline std::optional<std::filesystem::path> shared_dir() {
  const char* set = std::getenv("ORIEL_SHARED");
  const std::filesystem::path dir = set != nullptr && *set != '\0'
                                        ? std::filesystem::path(set)
                                        : std::filesystem::path(ORIEL_SOURCE_DIR) / ".." / "shared";
  if (!std::filesystem::exists(dir / "data")) return std::nullopt;
  return dir;
}

/// The CityJSON files of those sets of the shared data that have one building of LoD3 a file,
/// labelled and stripped; sorted.
inline std::vector<std::string> city_files(const std::filesystem::path& shared) {
  std::vector<std::string> files;
  for (const char* set : {"ingolstadt", "ogc-simple-house", "random3dcity"})
    for (const auto& entry : std::filesystem::directory_iterator(shared / "data" / set))
      if (entry.path().string().ends_with(".city.json")) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

}  // namespace oriel::test

/// Names the shared data folder `dir`, or leaves the test with the line "skipped" where it is
/// absent.
#define ORIEL_NEEDS_SHARED(dir)                            \
  const auto dir##_found = ::oriel::test::shared_dir();    \
  if (!dir##_found) {                                      \
    MESSAGE("skipped: no shared data (set ORIEL_SHARED)"); \
    return;                                                \
  }                                                        \
  const std::filesystem::path& dir = *dir##_found
