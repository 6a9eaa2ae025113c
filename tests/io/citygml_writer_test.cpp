#include "io/citygml/write/citygml_writer.h"

#include "io/citygml/write/xml_text.h"
#include "io/writer.h"
#include "kernel/base/index.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/support/shared.h"

#include <functional>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

namespace oriel {
namespace {

using namespace test;
using nlohmann::json;

constexpr Format kVersions[] = {Format::citygml2, Format::citygml3};

/// A file of records as CityGML.
std::string gml_of(const std::vector<Checked<Document>>& records, Format format) {
  std::string text;
  std::vector<Issue> issues;
  for (const auto& record : records)
    text += citygml_text(write_cityjson(*record.value, {}), *record.value, format, false, issues);
  return text + citygml_end();
}

std::string gml_of_text(const std::string& text, Format format) {
  const TemporaryFolder folder;
  return gml_of(read_all(folder.write("a.city.json", text)), format);
}

/// What is read of it: the CityObjects of all buildings.
json objects_of_gml(const std::string& gml, std::string* codes = nullptr) {
  const TemporaryFolder folder;
  json objects = json::object();
  for (const auto& record : read_all(folder.write("a.gml", gml))) {
    if (codes != nullptr) *codes += codes_of(record.issues);
    REQUIRE(record.value);
    const std::string text = write_cityjson(*record.value, {});
    if (text.empty()) continue;
    const json city = json::parse(text);
    objects.update(city["CityObjects"]);
  }
  return objects;
}

/// How often each polygon's semantics occurs in a geometry: type and members but what depends on
/// numbers.
std::map<std::string, int> polygons_by_surface(const json& geometry) {
  std::map<std::string, int> counts;
  const auto name_of = [&](const json& value) {
    if (!value.is_number()) return std::string("none");
    json surface = geometry["semantics"]["surfaces"][value.get<std::size_t>()];
    surface.erase("children");
    if (surface.contains("parent"))
      surface["parent"] =
          geometry["semantics"]["surfaces"][surface["parent"].get<std::size_t>()]["type"];
    return surface.dump();
  };
  const std::function<void(const json&, const json&, int)> visit =
      [&](const json& boundaries, const json& values, int depth) {
        for (std::size_t i = 0; i < boundaries.size(); ++i) {
          const json value = values.is_array() ? values[i] : json();
          if (depth > 0)
            visit(boundaries[i], value, depth - 1);
          else if (std::set<int>(boundaries[i][0].begin(), boundaries[i][0].end()).size() >= 3)
            ++counts[name_of(value)];
        }
      };
  const std::string type = geometry["type"];
  const bool is_many = type == "MultiSolid" || type == "CompositeSolid";
  const json values = geometry.contains("semantics") ? geometry["semantics"]["values"] : json();
  visit(geometry["boundaries"], values, is_many ? 2 : type == "Solid" ? 1 : 0);
  return counts;
}

const char* const kSurfaces =
    R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"WallSurface","children":[2],"slope":90},{"type":"Window","parent":1,"oriel_id":"fw","oriel_score":0.5,"oriel_label":"window"},{"type":"RoofSurface"},{"type":"Door"}],"values":[[0,3,1,2,4,null]]})";

BoxFile labelled_box() {
  BoxFile box;
  box.geometry = kSurfaces;
  box.lod = R"("3")";
  box.building =
      R"(,"attributes":{"class":"1000","function":["1","2"],"measuredHeight":2.5,"yearOfConstruction":1990,"storeysAboveGround":2,"name":"A & <B>","oriel_pack":"residential \"x\"","flag":true,"list":[1,2.5,3],"set":{"a":"b","c":4},"nothing":null},"children":["dormer"])";
  box.objects =
      R"(,"dormer":{"type":"BuildingInstallation","attributes":{"class":"1000","function":"1070","oriel_label":"dormer"},"parents":["house"],"geometry":[{"type":"MultiSurface","lod":"3","boundaries":[[[0,1,5,4]],[[1,2,6,5]]],"semantics":{"surfaces":[{"type":"WallSurface"},{"type":"Window","oriel_id":"fw"}],"values":[0,1]}}]})";
  box.root = R"(,"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"})";
  return box;
}

TEST_SUITE("io") {
  TEST_CASE("what is written as CityGML is read as the same objects") {
    const json expected = json::parse(labelled_box().text())["CityObjects"];
    for (const Format version : kVersions) {
      std::string codes;
      const std::string gml = gml_of_text(labelled_box().text(), version);
      CAPTURE(gml);
      const json objects = objects_of_gml(gml, &codes);
      CHECK(codes.empty());
      REQUIRE(objects.size() == 2);
      CHECK(objects["dormer"]["parents"] == json({"house"}));
      for (const char* id : {"house", "dormer"}) {
        REQUIRE(objects[id]["geometry"].size() == 1);
        const json geometry = objects[id]["geometry"][0];
        CHECK(geometry["type"] == expected[id]["geometry"][0]["type"]);
        CHECK(geometry["lod"] == "3");
        CHECK(polygons_by_surface(geometry) == polygons_by_surface(expected[id]["geometry"][0]));
      }
      json attributes = expected["house"]["attributes"];
      attributes.erase("nothing");
      attributes["flag"] = "true";
      CHECK(objects["house"]["attributes"] == attributes);
      CHECK(objects["dormer"]["attributes"] == expected["dormer"]["attributes"]);
    }
  }

  TEST_CASE("a polygon that building and installation share is written once") {
    for (const Format version : kVersions) {
      const std::string gml = gml_of_text(labelled_box().text(), version);
      std::size_t polygons = 0;
      for (std::size_t at = gml.find("<gml:Polygon"); at != std::string::npos;
           at = gml.find("<gml:Polygon", at + 1))
        ++polygons;
      CHECK(polygons == 6);
    }
  }

  TEST_CASE("objects that are not written are counted by type") {
    json city = json::parse(labelled_box().text());
    city["CityObjects"]["street"] = {{"type", "Road"}, {"geometry", json::array()}};
    city["CityObjects"]["lane"] = {{"type", "Road"}, {"geometry", json::array()}};
    city["CityObjects"]["tree"] = {{"type", "PlantCover"}, {"geometry", json::array()}};
    const TemporaryFolder folder;
    const auto records = read_all(folder.write("a.city.json", city.dump()));
    for (const Format format : kVersions) {
      std::vector<Issue> issues;
      for (const auto& record : records)
        citygml_text(write_cityjson(*record.value, {}), *record.value, format, false, issues);
      REQUIRE(issues.size() == 1);
      CHECK(issues[0].code == Code::E168);
      CHECK(issues[0].severity == Severity::warning);
      CHECK(issues[0].sentence.ends_with("are left out: 1 PlantCover, 2 Road"));
    }
  }

  TEST_CASE("the reference system comes back as it was") {
    for (const Format version : kVersions) {
      const auto record = read_text(gml_of_text(labelled_box().text(), version), "a.gml");
      REQUIRE(record.value);
      CHECK(
          write_cityjson(*record.value, {}).find("https://www.opengis.net/def/crs/EPSG/0/25832") !=
          std::string::npos);
    }
  }

  TEST_CASE("openings of level 2 go up to level 3 in version 2.0 and stay in 3.0") {
    BoxFile box = labelled_box();
    box.lod = R"("2.2")";
    const std::string three = R"("lod":"3")";
    box.objects.replace(box.objects.find(three), three.size(), R"("lod":"2.2")");
    for (const Format version : kVersions) {
      const json objects = objects_of_gml(gml_of_text(box.text(), version));
      const char* lod = version == Format::citygml2 ? "3" : "2";
      for (const char* id : {"house", "dormer"}) {
        REQUIRE(objects[id]["geometry"].size() == 1);
        CHECK(objects[id]["geometry"][0]["lod"] == lod);
      }
      CHECK(polygons_by_surface(objects["house"]["geometry"][0]) ==
            polygons_by_surface(json::parse(box.text())["CityObjects"]["house"]["geometry"][0]));
    }
  }

  TEST_CASE("ids that no XML id can be come back as they were") {
    for (const std::string& id :
         {std::string("0503100000012345-0"), std::string("{4A-b}"), std::string("a b"),
          std::string("<&>\"'"), std::string("é1"), std::string("_x0041_"), std::string("oriel.1"),
          std::string("\1"), std::string("\0", 1), std::string("日本"), std::string("a:b")}) {
      json city = json::parse(BoxFile().text());
      json& objects = city["CityObjects"];
      const std::string& key = id;
      objects[key] = objects["house"];
      objects.erase("house");
      for (const Format version : kVersions) {
        const json back = objects_of_gml(gml_of_text(city.dump(), version));
        CAPTURE(id);
        REQUIRE(back.size() == 1);
        CHECK(back.begin().key() == key);
        CHECK_FALSE(back.begin().value()["attributes"].contains("oriel_object_id"));
      }
    }
  }

  TEST_CASE("every id of characters becomes an XML name and comes back") {
    rc::check([] {
      const auto points = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 0x2FFF));
      std::string id;
      for (const int point : points) {
        const auto byte = [&](int bits) { id += static_cast<char>(bits); };
        if (point < 0x80) {
          byte(point);
        } else if (point < 0x800) {
          byte(0xC0 | point >> 6);
          byte(0x80 | (point & 0x3F));
        } else {
          byte(0xE0 | point >> 12);
          byte(0x80 | (point >> 6 & 0x3F));
          byte(0x80 | (point & 0x3F));
        }
      }
      const std::string name = detail::xml_id(id);
      RC_ASSERT(detail::xml_id_source(name) == id);
      RC_ASSERT(name.find_first_of(" <>&\"':/{}") == std::string::npos);
      RC_ASSERT(!(name[0] >= '0' && name[0] <= '9'));
    });
  }

  TEST_CASE("files of the shared data come back from CityGML with the same surfaces") {
    ORIEL_NEEDS_SHARED(shared);
    constexpr std::size_t kStep = 7;
    const auto files = city_files(shared);
    std::size_t polygons = 0;
    for (std::size_t i = 0; i < files.size(); i += kStep) {
      const auto records = read_all(files[i]);
      REQUIRE(records.at(0).value);
      const json expected = json::parse(write_cityjson(*records[0].value, {}))["CityObjects"];
      const Format version = kVersions[i % 2];
      const json objects = objects_of_gml(gml_of(records, version));
      CAPTURE(files[i]);
      for (const auto& [id, object] : expected.items()) {
        REQUIRE(objects.contains(id));
        for (const json& geometry : object["geometry"]) {
          REQUIRE(objects[id]["geometry"].size() == object["geometry"].size());
          const auto surfaces = polygons_by_surface(geometry);
          CHECK(polygons_by_surface(objects[id]["geometry"][0]) == surfaces);
          for (const auto& [surface, count] : surfaces) polygons += at(count);
        }
      }
    }
    CHECK(polygons > 1000);
  }
}

}  // namespace
}  // namespace oriel
