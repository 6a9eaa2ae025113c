#pragma once

#include "io/reader.h"
#include "kernel/validate/validate.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel::test {

/// "E341 104, E344 203": code and val3dity's number of each finding.
inline std::string codes_of(const Building& building) {
  std::string codes;
  for (const Finding& finding : validate(building))
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", to_string(finding.code),
                         finding.val3dity);
  return codes;
}

inline std::vector<Finding> for_any_judge(const Building& building) {
  ValidateOptions options;
  options.judge = ValidateOptions::Judge::any;
  return validate(building, options);
}

/// The buildings of the CityJSON files of tests/data/errors that can be read, by file name.
inline std::vector<std::pair<std::string, Building>> error_buildings() {
  std::vector<std::pair<std::string, Building>> found;
  const auto folder = std::filesystem::path(ORIEL_SOURCE_DIR) / "tests" / "data" / "errors";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    Reader reader(entry.path().string());
    const auto record = reader.next();
    if (record && record->value)
      for (const Building& building : record->value->buildings)
        found.emplace_back(entry.path().filename().string(), building);
  }
  REQUIRE(found.size() > 25);
  return found;
}

}  // namespace oriel::test
