#include "model/canonical_order.h"
#include "oriel/oriel.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/shared.h"

#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

/// The stripped buildings of all sets, and the files with several buildings.
std::vector<std::string> files_with_buildings(const std::filesystem::path& data) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    const std::string path = entry.path().string();
    const bool is_of_faults =
        path.find("/cases/") != std::string::npos || path.find("/faults/") != std::string::npos;
    if (!is_of_faults && (path.ends_with(".stripped.city.json") || path.ends_with(".city.jsonl") ||
                          path.ends_with("delfshaven.city.json")))
      files.push_back(path);
  }
  std::ranges::sort(files);
  return files;
}

/// Every feature with its label and its host.
std::set<std::tuple<std::string, std::string, std::string>> labels_of(const Building& building,
                                                                      const RuleBase& rules) {
  const PipelineResult result = label(building, rules, {});
  std::set<std::tuple<std::string, std::string, std::string>> labels;
  for (const FeatureRecord& record : feature_records(building, result))
    labels.emplace(record.id, record.label, record.host);
  return labels;
}

TEST_SUITE("oriel") {
  TEST_CASE("ids and labels do not depend on the order in which polygons were read") {
    const auto shared = test::shared_dir();
    if (!shared) {
      MESSAGE("skipped: no shared data");
      return;
    }
    const RuleBase rules = load_pack_file("residential").value.value();
    std::size_t count = 0;
    for (const std::string& file : files_with_buildings(*shared / "data")) {
      Reader reader(file);
      while (const auto record = reader.next()) {
        if (!record->value) continue;
        for (const Building& building : record->value->buildings) {
          CAPTURE(building.id);
          const Building other = test::shuffled(building, ++count);
          const CanonicalOrder order(building), again(other);
          REQUIRE(order.building.vertices == again.building.vertices);
          for (std::size_t i = 0; i < order.building.polygons.size(); ++i)
            REQUIRE(order.building.polygons[i].rings == again.building.polygons[i].rings);
          // What follows sees the canonical order only; some of all kinds are labelled to hold
          // that.
          constexpr std::size_t kEach = 16;
          const bool is_open_survey = file.find("ingolstadt") != std::string::npos;
          if (is_open_survey || count % kEach == 0)
            CHECK(labels_of(other, rules) == labels_of(building, rules));
        }
      }
    }
    CHECK(count > 1000);
  }
}

}  // namespace
