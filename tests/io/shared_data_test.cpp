#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/files.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <sstream>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using nlohmann::json;
using test::city_files;
using test::codes_of;

/// Polygons of a geometry, counted in a parse of our own.
std::size_t polygon_count(const json& geometry) {
  const std::string type = geometry["type"];
  std::size_t count = 0;
  if (type == "MultiSurface") return geometry["boundaries"].size();
  for (const json& shell : geometry["boundaries"]) count += shell.size();
  REQUIRE(type == "Solid");
  return count;
}

/// Every polygon a wall but for one window; the first three polygons are an installation.
std::vector<LabelledBuilding> labels_for(const Document& document) {
  std::vector<LabelledBuilding> labelled;
  for (const Building& building : document.buildings) {
    LabelledBuilding& one = labelled.emplace_back();
    one.building = building.id;
    one.surfaces = {{"WallSurface", -1, {}}, {"Window", 0, FeatureLabel{.id = "w1"}}};
    one.surface_of_polygon.assign(building.polygons.size(), 0);
    one.surface_of_polygon.back() = 1;
    one.attributes = {{"oriel_version", std::string("0.1.0")}};
    one.installations = {{building.id + "-i", FeatureLabel{.class_code = "1000"}, {0, 1}, {0, 0}}};
  }
  return labelled;
}

TEST_SUITE("io") {
  TEST_CASE("every CityJSON file of the shared data is read as an independent parser counts it") {
    ORIEL_NEEDS_SHARED(shared);
    const auto files = city_files(shared);
    CHECK(files.size() == 192);
    for (const std::string& path : files) {
      CAPTURE(path);
      const std::string text = test::text_of(path);
      const json file = json::parse(text);
      ReadOptions options;
      options.joins_installations = false;
      const auto records = test::read_all(path, options);
      REQUIRE(records.size() == 1);
      CHECK_FALSE(has_errors(records[0].issues));
      REQUIRE(records[0].value);
      const Document& document = *records[0].value;
      REQUIRE(document.buildings.size() == 1);
      CHECK(document.buildings[0].polygons.size() ==
            polygon_count(file["CityObjects"][document.buildings[0].id]["geometry"][0]));
      CHECK(write_cityjson(document, {}) == text);
    }
  }

  TEST_CASE("labels on the shared data make valid files and twice the same bytes") {
    ORIEL_NEEDS_SHARED(shared);
    for (const std::string& path : city_files(shared)) {
      CAPTURE(path);
      const auto records = test::read_all(path);
      const auto labelled = labels_for(records.at(0).value.value());
      const std::string out = write_cityjson(*records[0].value, labelled);
      for (const std::string& fault : test::structural_faults(json::parse(out))) FAIL_CHECK(fault);
      const auto again = test::read_text(out);
      CHECK(write_cityjson(again.value.value(), labelled) == out);
    }
  }

  TEST_CASE("3DBAG is read feature by feature at the level asked for") {
    ORIEL_NEEDS_SHARED(shared);
    const std::string path = shared / "data" / "3dbag" / "tile_5910.city.jsonl";
    std::istringstream lines(test::text_of(path));
    std::string line;
    std::getline(lines, line);
    const json header = json::parse(line);
    Reader reader(path, {"2.2", {}});
    CHECK(write_cityjson(*reader.next()->value, {}) == line + "\n");
    std::size_t buildings = 0;
    std::string errors;
    while (auto record = reader.next()) {
      REQUIRE(record->value);
      errors += has_errors(record->issues) ? codes_of(record->issues) : "";
      REQUIRE(std::getline(lines, line));
      CHECK(write_cityjson(*record->value, {}) == line + "\n");
      const json feature = json::parse(line);
      for (const Building& building : record->value->buildings) {
        ++buildings;
        const json& geometries = feature["CityObjects"][building.id]["geometry"];
        const auto chosen =
            std::ranges::find_if(geometries, [](const json& g) { return g["lod"] == "2.2"; });
        CHECK(building.polygons.size() == polygon_count(*chosen));
        CHECK_FALSE(building.polygons[0].hint.empty());
      }
      const std::string out = write_cityjson(*record->value, labels_for(*record->value));
      for (const std::string& fault : test::structural_faults(json::parse(out), header))
        FAIL_CHECK(fault);
    }
    // Of the 211 features one has a footprint only and one has two parts.
    CHECK(buildings == 211);
    CHECK(errors == "E205");
  }
}

}  // namespace
}  // namespace oriel
