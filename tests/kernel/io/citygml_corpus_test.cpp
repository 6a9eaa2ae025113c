#include "examples/generator/citygml.h"
#include "examples/generator/generate.h"
#include "tests/kernel/io/citygml_samples.h"
#include "tests/kernel/io/files.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using namespace test;
using nlohmann::json;

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
      if (issue.severity == Severity::error) CHECK(issue.code == "E205");  // not at this level
    REQUIRE(record.value);
    for (Building& building : record.value->buildings) buildings.push_back(std::move(building));
  }
  return buildings;
}

/// Turns buildings that were read into a CityGML file: level `lod`, polygons with a hint in a
/// boundary surface of their own, in openings' case below a wall; the geometry links to them.
class Converter {
 public:
  Converter(std::string version, char lod) : version_(std::move(version)), lod_(lod) {}

  std::string file(const std::vector<Building>& buildings) {
    std::string members;
    for (const Building& building : buildings) {
      ++number_;
      members += test::building(building.id, content_of(building));
    }
    return CityGmlFile{version_, members}.text();
  }

 private:
  [[nodiscard]] bool is_v3() const { return version_ == "3.0"; }

  [[nodiscard]] std::string lod_property(const std::string& kind, const std::string& inside) const {
    return element(fmt::format("{}lod{}{}", is_v3() ? "c:" : "bldg:", lod_, kind), inside);
  }

  static std::string positions(const Building& building, const std::vector<int>& ring) {
    std::string text;
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Vec3 p = building.vertices[static_cast<std::size_t>(ring[i % ring.size()])] +
                     building.frame.origin_m;
      text += fmt::format("{} {} {} ", p.x, p.y, p.z);
    }
    return text;
  }

  std::string polygon_text(const Building& building, const Polygon& polygon) const {
    std::string rings = element("gml:exterior", ring(positions(building, polygon.rings[0])));
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      rings += element("gml:interior", ring(positions(building, polygon.rings[r])));
    return element("gml:Polygon", rings, fmt::format("gml:id=\"{}\"", id_of(polygon)));
  }

  [[nodiscard]] std::string id_of(const Polygon& polygon) const {
    return fmt::format("b{}p{}", number_, polygon.source);
  }

  std::string boundary(const Polygon& polygon, const std::string& text) const {
    const std::string space = is_v3() ? "con:" : "bldg:";
    const std::string surface = lod_property("MultiSurface", multi_surface(surface_member(text)));
    const bool is_opening = polygon.hint == "Window" || polygon.hint == "Door";
    std::string inside = surface;
    if (is_opening) {
      const std::string name = fmt::format("{}{}{}", space, polygon.hint, is_v3() ? "Surface" : "");
      inside = element(is_v3() ? "con:fillingSurface" : "bldg:opening", element(name, surface));
    }
    return element(
        is_v3() ? "c:boundary" : "bldg:boundedBy",
        element(fmt::format("{}{}", space, is_opening ? "WallSurface" : polygon.hint), inside));
  }

  std::string content_of(const Building& building) const {
    std::string boundaries, members, geometry;
    for (const Polygon& polygon : building.polygons) {
      const std::string text = polygon_text(building, polygon);
      if (polygon.hint.empty()) {
        members += surface_member(text);
      } else {
        boundaries += boundary(polygon, text);
        members += link_to(id_of(polygon));
      }
    }
    geometry = building.is_solid ? lod_property("Solid", solid(members))
                                 : lod_property("MultiSurface", multi_surface(members));
    return boundaries + geometry;
  }

  std::string version_;
  char lod_;
  int number_ = 0;
};

/// All CityJSON files of the shared data.
std::vector<std::string> city_files(const std::filesystem::path& shared) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared / "data"))
    if (entry.path().string().ends_with(".city.json")) files.push_back(entry.path().string());
  std::ranges::sort(files);
  return files;
}

TEST_SUITE("kernel/io") {
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
      const auto found =
          buildings_of(folder.write("a.gml", Converter(version, '3').file(expected)));
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
    const auto found = buildings_of(folder.write("a.gml", Converter("2.0", '2').file(expected)));
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
