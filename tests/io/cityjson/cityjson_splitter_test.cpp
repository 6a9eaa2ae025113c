#include "io/cityjson/cityjson_splitter.h"

#include "io/cityjson/cityjson_collector.h"
#include "io/reader.h"
#include "tests/io/files.h"

#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using nlohmann::json;

namespace {

/// A house with a part, a road between them in the file, and a tower with its own material and
/// texture. Each has one triangle.
const char* const kCity = R"({"type":"CityJSON","version":"2.0","x-own":[1],
 "transform":{"scale":[0.001,0.001,0.001],"translate":[10,20,0]},
 "appearance":{"default-theme-material":"day","materials":[{"name":"brick"},{"name":"slate"}],
  "textures":[{"type":"PNG","image":"a.png"},{"type":"PNG","image":"b.png"}],
  "vertices-texture":[[0,0],[1,0],[0,1],[1,1]]},
 "CityObjects":{
  "house":{"type":"Building","children":["part"],"geometry":[{"type":"MultiSurface","lod":"2",
    "boundaries":[[[3,4,5]]],"material":{"day":{"value":1}}}]},
  "road":{"type":"Road","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]},
  "part":{"type":"BuildingPart","parents":["house"],"geometry":[{"type":"MultiSurface","lod":"2",
    "boundaries":[[[5,6,3]]],"material":{"day":{"values":[0]}}}]},
  "tower":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2",
    "boundaries":[[[2,7,8]],[[8,7,0]]],"material":{"day":{"values":[1,null]}},
    "texture":{"day":{"values":[[[1,3,2,1]],[[null]]]}}}]}},
 "vertices":[[0,0,0],[1000,0,0],[1000,1000,0],[2000,0,0],[3000,0,0],[3000,1000,0],[2000,1000,0],
  [0,0,9000],[1000,0,9000]]})";

Document split_document(const std::string& text) {
  const test::TemporaryFolder folder;
  Reader reader(folder.write("city.city.json", text));
  auto record = reader.next();
  REQUIRE(record->value);
  return std::move(*record->value);
}

}  // namespace

TEST_SUITE("io") {
  TEST_CASE("a file is taken apart into features of what hangs together") {
    const Document city = split_document(kCity);
    const CityJsonSplitter splitter(city);
    REQUIRE(splitter.size() == 3);
    CHECK(splitter.ids(0) == std::vector<std::string>{"house", "part"});
    CHECK(splitter.ids(1) == std::vector<std::string>{"road"});
    const json header = json::parse(splitter.header());
    CHECK(header["x-own"] == json{1});
    CHECK(header["appearance"] == json{{"default-theme-material", "day"}});
    CHECK(header["CityObjects"].empty());
    CHECK(header["vertices"].empty());
    const std::string line = splitter.feature(0);
    CHECK(line.find('\n') == line.size() - 1);
    const json house = json::parse(line);
    CHECK(house["id"] == "house");
    CHECK(house["CityObjects"]["house"]["geometry"][0]["boundaries"] == json::parse("[[[0,1,2]]]"));
    CHECK(house["CityObjects"]["part"]["geometry"][0]["boundaries"] == json::parse("[[[2,3,0]]]"));
    CHECK(house["vertices"] == json::parse("[[2000,0,0],[3000,0,0],[3000,1000,0],[2000,1000,0]]"));
  }

  TEST_CASE("a feature has the materials and textures that it uses") {
    const Document city = split_document(kCity);
    const json tower = json::parse(CityJsonSplitter(city).feature(2));
    const json& geometry = tower["CityObjects"]["tower"]["geometry"][0];
    CHECK(geometry["material"]["day"]["values"] == json::parse("[0,null]"));
    CHECK(geometry["texture"]["day"]["values"] == json::parse("[[[0,0,1,2]],[[null]]]"));
    CHECK(tower["appearance"] == json::parse(R"({"materials":[{"name":"slate"}],
      "textures":[{"type":"PNG","image":"b.png"}],"vertices-texture":[[1,1],[0,1],[1,0]]})"));
  }

  TEST_CASE("features that are collected again have the geometry and appearance of the file") {
    const Document city = split_document(kCity);
    const CityJsonSplitter splitter(city);
    CityJsonCollector collector;
    collector.add(splitter.header());
    for (std::size_t i = 0; i < splitter.size(); ++i) CHECK(!collector.add(splitter.feature(i)));
    const json before = json::parse(kCity), after = json::parse(collector.text());
    CHECK(after["appearance"]["materials"].size() == 2);
    for (const auto& [id, object] : before["CityObjects"].items()) {
      CAPTURE(id);
      const json &old = object["geometry"][0], &now = after["CityObjects"][id]["geometry"][0];
      for (std::size_t polygon = 0; polygon < old["boundaries"].size(); ++polygon)
        for (std::size_t corner = 0; corner < 3; ++corner)
          CHECK(before["vertices"][old["boundaries"][polygon][0][corner].get<std::size_t>()] ==
                after["vertices"][now["boundaries"][polygon][0][corner].get<std::size_t>()]);
    }
    const auto material_of = [](const json& file, const std::string& id) {
      const json& theme = file["CityObjects"][id]["geometry"][0]["material"]["day"];
      const json& number = theme.contains("value") ? theme["value"] : theme["values"][0];
      return file["appearance"]["materials"][number.get<std::size_t>()]["name"];
    };
    for (const std::string id : {"house", "part", "tower"})
      CHECK(material_of(after, id) == material_of(before, id));
    CHECK(after["x-own"] == before["x-own"]);
  }

  TEST_CASE("a CityObject that an earlier line had is not collected twice") {
    const Document city = split_document(kCity);
    const CityJsonSplitter splitter(city);
    CityJsonCollector collector;
    collector.add(splitter.header());
    CHECK(!collector.add(splitter.feature(0)));
    const std::string once = collector.text();
    CHECK(collector.add(splitter.feature(0)) == "house");
    CHECK(collector.text() == once);
  }

  TEST_CASE("a vertex number that the file does not have stays wrong in the feature") {
    std::string text = kCity;
    text.replace(text.find("[[[0,1,2]]]"), 11, "[[[0,1,9]]]");
    const Document city = split_document(text);
    const json road = json::parse(CityJsonSplitter(city).feature(1));
    CHECK(road["CityObjects"]["road"]["geometry"][0]["boundaries"] == json::parse("[[[0,1,9]]]"));
    CHECK(road["vertices"].size() == 2);
  }
}
