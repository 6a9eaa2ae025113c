#include "examples/generator/generate.h"
#include "examples/generator/output/citygml.h"
#include "tests/io/files.h"
#include "tests/support/citygml_samples.h"
#include "tests/support/shared.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using namespace test;

/// A polygon in the input's coordinates: its rings, and what it was said to be.
struct Placed {
  std::vector<std::vector<Vec3>> rings;
  std::string hint;
  int body = 0;
  int shell = 0;
};

std::vector<Placed> placed(const Building& building) {
  std::vector<Placed> polygons;
  for (const Polygon& polygon : building.polygons) {
    Placed& one = polygons.emplace_back(Placed{{}, polygon.hint, polygon.body, polygon.shell});
    for (const auto& ring : polygon.rings) {
      auto& corners = one.rings.emplace_back();
      for (const int v : ring)
        corners.push_back(building.vertices[static_cast<std::size_t>(v)] + building.frame.origin_m);
      // A tile names vertices twice that lie at the same place.
      const auto same = [](Vec3 a, Vec3 b) { return length(a - b) < 1e-6; };
      corners.erase(std::unique(corners.begin(), corners.end(), same), corners.end());
      while (corners.size() > 1 && same(corners.front(), corners.back())) corners.pop_back();
    }
  }
  return polygons;
}

/// Fails unless the two have the same polygons in the same order, to the micrometre.
void check_same(const Building& building, const Building& expected) {
  CHECK(building.is_solid == expected.is_solid);
  CHECK(building.lod == expected.lod);
  const std::vector<Placed> found = placed(building), wanted = placed(expected);
  REQUIRE(found.size() == wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i].hint == wanted[i].hint);
    CHECK(found[i].body == wanted[i].body);
    CHECK(found[i].shell == wanted[i].shell);
    REQUIRE(found[i].rings.size() == wanted[i].rings.size());
    for (std::size_t r = 0; r < found[i].rings.size(); ++r) {
      REQUIRE(found[i].rings[r].size() == wanted[i].rings[r].size());
      for (std::size_t k = 0; k < found[i].rings[r].size(); ++k) {
        const Vec3 d = found[i].rings[r][k] - wanted[i].rings[r][k];
        const double off = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        if (off > 1e-6) FAIL_CHECK("a corner is off by ", off);
      }
    }
  }
}

std::vector<Building> buildings_of(const std::string& path, const std::string& lod = "") {
  ReadOptions options;
  if (!lod.empty()) options.lod = lod;
  std::vector<Building> buildings;
  for (auto& record : read_all(path, options)) {
    for (const Issue& issue : record.issues)
      if (issue.severity == Severity::error) CHECK(issue.code == Code::E205);  // not at this level
    REQUIRE(record.value);
    for (Building& building : record.value->buildings) buildings.push_back(std::move(building));
  }
  return buildings;
}

TEST_SUITE("io") {
  TEST_CASE("generated houses are the same from CityGML as from CityJSON") {
    const TemporaryFolder folder;
    generator::Options options;
    options.seed = 4;
    options.flush = 0.3;
    options.origin = {678'114'000'000, 5'403'766'000'000, 370'000'000};
    for (int i = 0; i < 12; ++i) {
      const generator::Building house{"house", generator::generate(options, i), options.origin};
      for (const auto content : {generator::Content::labelled, generator::Content::stripped}) {
        const auto expected =
            buildings_of(folder.write("a.city.json", generator::cityjson(house, content)));
        for (const auto version : {generator::CityGml::v2, generator::CityGml::v3}) {
          CAPTURE(i);
          const auto found =
              buildings_of(folder.write("a.gml", generator::citygml(house, content, version)));
          REQUIRE(found.size() == 1);
          CHECK(found[0].is_solid);
          check_same(found[0], expected.at(0));
        }
      }
    }
  }

  TEST_CASE("the shared data are the same when they were turned into CityGML") {
    ORIEL_NEEDS_SHARED(shared);
    const TemporaryFolder folder;
    std::size_t count = 0;
    for (const std::string& path : city_files(shared)) {
      CAPTURE(path);
      const auto expected = buildings_of(path);
      const std::string version = ++count % 2 == 0 ? "2.0" : "3.0";
      const auto found = buildings_of(folder.write("a.gml", citygml_of(expected, version, '3')));
      REQUIRE(found.size() == expected.size());
      for (std::size_t i = 0; i < found.size(); ++i) check_same(found[i], expected[i]);
    }
    CHECK(count == 192);
  }

  TEST_CASE("a tile of buildings is the same when it was turned into CityGML") {
    ORIEL_NEEDS_SHARED(shared);
    const TemporaryFolder folder;
    auto expected = buildings_of(shared / "data" / "3dbag" / "tile_5910.city.jsonl", "2.2");
    CHECK(expected.size() > 200);
    const auto found = buildings_of(folder.write("a.gml", citygml_of(expected, "2.0", '2')));
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CAPTURE(found[i].id);
      expected[i].lod.resize(1);  // CityGML has whole levels
      check_same(found[i], expected[i]);
      CHECK(found[i].id == expected[i].id);
    }
  }
}

}  // namespace
}  // namespace oriel
