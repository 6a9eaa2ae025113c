#include "examples/generator/generate.h"
#include "examples/generator/output/truth.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::generator {
namespace {

using nlohmann::json;

constexpr int kHouses = 60;

/// Every third house is of the English style.
Building make_building(int index) {
  Options options;
  if (index % 3 == 2) options.style = Style::english;
  options.origin = {604'000'000'000, 5'403'766'000'000, 370'000'000};
  options.flush = 0.3;
  options.noise = index % 2 == 0 ? 0 : 1'000;
  options.triangulate = index % 5 == 4;
  return {"house", generate(options, index), options.origin};
}

Building stripped_of(const Building& building) {
  Random random(5);
  return {building.id, shuffled(building.body, random), building.origin};
}

/// Corners of a ring from its smallest one on: equal for rings that differ in their start only.
using Corners = std::vector<std::array<Um, 3>>;
Corners canonical(const json& file, const json& ring) {
  Corners corners;
  for (const json& vertex : ring) corners.push_back(file["vertices"][vertex.get<std::size_t>()]);
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// All polygons of the solid, each with its rings in canonical form.
std::multiset<std::vector<Corners>> polygons_of(const json& file) {
  std::multiset<std::vector<Corners>> polygons;
  for (const json& polygon : file["CityObjects"]["house"]["geometry"][0]["boundaries"][0]) {
    std::vector<Corners> rings;
    for (const json& ring : polygon) rings.push_back(canonical(file, ring));
    polygons.insert(rings);
  }
  return polygons;
}

json box_of(const json& file, const std::vector<int>& faces) {
  std::array<double, 6> box{1e18, 1e18, 1e18, -1e18, -1e18, -1e18};
  const json& boundaries = file["CityObjects"]["house"]["geometry"][0]["boundaries"][0];
  for (const int face : faces)
    for (const json& vertex : boundaries[static_cast<std::size_t>(face)][0])
      for (std::size_t k = 0; k < 3; ++k) {
        const double steps = file["vertices"][vertex.get<std::size_t>()][k];
        const double value = steps * 1e-6 + file["transform"]["translate"][k].get<double>();
        box[k] = std::min(box[k], value);
        box[k + 3] = std::max(box[k + 3], value);
      }
  return box;
}

bool are_near(const json& a, const json& b) {
  for (std::size_t i = 0; i < 6; ++i)
    if (std::abs(a[i].get<double>() - b[i].get<double>()) > 1e-6) return false;
  return true;
}

TEST_SUITE("examples/generator") {
  TEST_CASE("the same seed gives the same bytes and another one others") {
    const Building a = make_building(7), b = make_building(7), other = make_building(8);
    CHECK(cityjson(a, Content::labelled) == cityjson(b, Content::labelled));
    CHECK(cityjson(stripped_of(a), Content::stripped) ==
          cityjson(stripped_of(b), Content::stripped));
    CHECK(truth_json(a) == truth_json(b));
    CHECK(cityjson(a, Content::labelled) != cityjson(other, Content::labelled));
  }

  TEST_CASE("the stripped file is a shuffle of the labelled one without semantics") {
    for (int i = 0; i < kHouses; ++i) {
      const Building building = make_building(i);
      const std::string text = cityjson(stripped_of(building), Content::stripped);
      const json labelled = json::parse(cityjson(building, Content::labelled));
      const json stripped = json::parse(text);
      CHECK(polygons_of(labelled) == polygons_of(stripped));
      CHECK(labelled["vertices"] != stripped["vertices"]);
      CHECK(labelled["transform"] == stripped["transform"]);
      CHECK(stripped["CityObjects"].size() == 1);
      CHECK(text.find("semantics") == std::string::npos);
      CHECK(text.find("oriel") == std::string::npos);
    }
  }

  TEST_CASE("the truth names every polygon once and its boxes bound them") {
    for (int i = 0; i < kHouses; ++i) {
      const Building building = stripped_of(make_building(i));
      const json file = json::parse(cityjson(building, Content::stripped));
      const json truth = json::parse(truth_json(building));
      std::multiset<int> named;
      std::set<std::string> ids{""};
      for (const json& object : truth["objects"]) ids.insert(object["id"]);
      CHECK(ids.size() == truth["objects"].size() + 1);
      for (const json& object : truth["objects"]) {
        const std::vector<int> faces = object["faces"];
        REQUIRE_FALSE(faces.empty());
        named.insert(faces.begin(), faces.end());
        CHECK(are_near(object["aabb"], box_of(file, faces)));
        for (const char* key : {"parent", "host"})
          if (!object[key].is_null()) CHECK(ids.count(object[key]) == 1);
        if (!object.contains("recess_m")) continue;
        std::vector<int> all = object["niche_faces"];
        named.insert(all.begin(), all.end());
        all.insert(all.end(), faces.begin(), faces.end());
        CHECK(are_near(object["feature_aabb"], box_of(file, all)));
        CHECK(object["detectable"] == (object["recess_m"].get<double>() >= 0.002));
      }
      CHECK(named.size() == building.body.polygons.size());
      CHECK(std::set<int>(named.begin(), named.end()).size() == named.size());
    }
  }

  TEST_CASE("openings are children of the surface they are cut into") {
    for (int i = 0; i < kHouses; ++i) {
      const json file = json::parse(cityjson(make_building(i), Content::labelled));
      const json& geometry = file["CityObjects"]["house"]["geometry"][0];
      const json& surfaces = geometry["semantics"]["surfaces"];
      CHECK(geometry["semantics"]["values"][0].size() == geometry["boundaries"][0].size());
      for (std::size_t k = 0; k < surfaces.size(); ++k) {
        const bool is_opening = surfaces[k]["type"] == "Window" || surfaces[k]["type"] == "Door";
        CHECK(is_opening == surfaces[k].contains("parent"));
        if (!is_opening) continue;
        const json& host = surfaces[surfaces[k]["parent"].get<std::size_t>()];
        const std::vector<std::size_t> children = host["children"];
        CHECK(std::count(children.begin(), children.end(), k) == 1);
        CHECK((host["type"] == "WallSurface" || host["type"] == "RoofSurface"));
      }
    }
  }

  TEST_CASE("installations are children of the building and share its polygons") {
    int installations = 0;
    for (int i = 0; i < kHouses; ++i) {
      const json file = json::parse(cityjson(make_building(i), Content::labelled));
      const auto solid = polygons_of(file);
      const json& house = file["CityObjects"]["house"];
      CHECK(file["CityObjects"].size() == house.value("children", json::array()).size() + 1);
      for (const json& id : house.value("children", json::array())) {
        const json& part = file["CityObjects"][id.get<std::string>()];
        CHECK(part["type"] == "BuildingInstallation");
        CHECK(part["parents"] == json::array({"house"}));
        for (const json& polygon : part["geometry"][0]["boundaries"]) {
          std::vector<Corners> rings;
          for (const json& ring : polygon) rings.push_back(canonical(file, ring));
          CHECK(solid.count(rings) == 1);
        }
        ++installations;
      }
    }
    CHECK(installations > kHouses);
  }
}

}  // namespace
}  // namespace oriel::generator
