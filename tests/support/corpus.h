#pragma once

#include "io/reader.h"
#include "kernel/solidify/solidify.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace oriel::test {

/// The files of a folder whose names end so, in order.
inline std::vector<std::string> files_in(const std::filesystem::path& folder,
                                         const std::string& ending) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().string().ends_with(ending)) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

/// The buildings of files that make a solid, and the names of those that do not.
struct Corpus {
  std::vector<Building> buildings;
  std::vector<std::string> set_aside;
};

inline Corpus corpus_of(const std::vector<std::string>& files) {
  Corpus corpus;
  for (const std::string& file : files) {
    Reader reader(file);
    while (const auto record = reader.next()) {
      if (!record->value) continue;
      for (const Building& building : record->value->buildings) {
        if (solidify(building, {}).value)
          corpus.buildings.push_back(building);
        else
          corpus.set_aside.push_back(building.id);
      }
    }
  }
  return corpus;
}

/// The sample buildings of the examples: all of them solids.
inline Corpus samples() {
  return corpus_of(files_in(std::filesystem::path(ORIEL_SOURCE_DIR) / "examples" / "samples",
                            ".stripped.city.json"));
}

}  // namespace oriel::test
