#include "io/cityjson/added_transform.h"

#include "io/cityjson/cityjson_splitter.h"
#include "io/writer.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using nlohmann::json;
using test::BoxFile;
using test::codes_of;
using test::read_text;

/// The box of BoxFile in CityJSON 1.0: without a transform, the level of detail a number.
std::string box_1_0(const std::string& lod = "2.2") {
  return R"({"type":"CityJSON", "version":"1.0",
    "metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::7415","presentLoDs":{"2.2":1}},
    "CityObjects":{"house":{"type":"Building","address":{"x":1},
      "geometry":[{"type":"Solid","lod":)" +
         lod + R"(,"boundaries":)" + BoxFile().boundaries + R"(}]}},
    "vertices":[[1000.5,2000.25,10.0],[1004.5,2000.25,10],[1004.5,2003.25,10],[1000.5,2003.25,1e1],
      [1000.5,2000.25,12],[1004.5,2000.25,12],[1004.5,2003.25,12],[1000.5,2003.25,12]]})";
}

TEST_SUITE("io") {
  TEST_CASE("a level of detail that is a number keeps the digits that it is written with") {
    for (const std::string lod : {"0", "2", "2.0", "2.2", "3.3"}) {
      CAPTURE(lod);
      const auto read = read_text(box_1_0(lod));
      REQUIRE(read.value);
      REQUIRE(read.value->buildings.size() == 1);
      CHECK(read.value->buildings[0].lod == lod);
    }
  }

  TEST_CASE("a building of CityJSON 1.0 without transform is the one of CityJSON 2.0") {
    const auto old = read_text(box_1_0());
    const auto expected = read_text(BoxFile().text());
    CHECK(codes_of(old.issues) == "");
    REQUIRE(old.value);
    REQUIRE(old.value->buildings.size() == 1);
    const Building& building = old.value->buildings[0];
    const Building& other = expected.value->buildings.at(0);
    CHECK(building.lod == "2.2");
    CHECK(building.is_solid);
    CHECK(building.frame.origin_m == other.frame.origin_m);
    CHECK(building.frame.crs == "urn:ogc:def:crs:EPSG::7415");
    CHECK(building.vertices == other.vertices);
    REQUIRE(building.polygons.size() == 6);
    for (std::size_t i = 0; i < 6; ++i)
      CHECK(building.polygons[i].rings == other.polygons[i].rings);
  }

  TEST_CASE("a level of detail that is a number is called as it is written") {
    CHECK(read_text(box_1_0("2")).value->buildings.at(0).lod == "2");
    CHECK(read_text(box_1_0("2.0")).value->buildings.at(0).lod == "2.0");
    CHECK(read_text(box_1_0("\"1.2\"")).value->buildings.at(0).lod == "1.2");
    CHECK(codes_of(read_text(box_1_0("2.2"), "a.city.json", {"2.2", {}}).issues) == "");
    CHECK(codes_of(read_text(box_1_0("2.2"), "a.city.json", {"2", {}}).issues) == "E205");
    CHECK(codes_of(read_text(box_1_0("true")).issues) == "E202");
  }

  TEST_CASE("a level of detail that is a number is refused after CityJSON 1.0") {
    BoxFile file;
    file.lod = "2.2";
    CHECK(codes_of(read_text(file.text()).issues) == "E202");
  }

  TEST_CASE("a CityJSON 1.0 file keeps its version and gets a transform when it is written") {
    const auto record = read_text(box_1_0());
    LabelledBuilding labelled;
    labelled.building = "house";
    labelled.surface_of_polygon = {-1, 0, -1, -1, -1, -1};
    labelled.surfaces = {{"RoofSurface", {}, {}}};
    const json file = json::parse(write_cityjson(*record.value, {labelled}));
    CHECK(file["version"] == "1.0");
    CHECK(file["transform"] ==
          json::parse(R"({"scale":[0.001,0.001,0.001],"translate":[1000,2000,10]})"));
    CHECK(file["vertices"][0] == json{500, 250, 0});
    CHECK(file["vertices"][6] == json{4500, 3250, 2000});
    const json& house = file["CityObjects"]["house"];
    CHECK(house["address"] == json{{"x", 1}});
    CHECK(house["geometry"][0]["lod"] == json(2.2));
    CHECK(house["geometry"][0]["semantics"]["surfaces"][0]["type"] == "RoofSurface");
    const std::string again = write_cityjson(*record.value, {});
    const auto reread = read_text(again);
    CHECK(write_cityjson(*reread.value, {}) == again);
    CHECK(reread.value->buildings.at(0).vertices == record.value->buildings[0].vertices);
  }

  TEST_CASE("a level of detail that is written into CityJSON 1.0 is a number there") {
    const auto record = read_text(box_1_0("2"));
    LabelledBuilding labelled;
    labelled.building = "house";
    labelled.lod = "1.2";
    const json file = json::parse(write_cityjson(*record.value, {labelled}));
    CHECK(file["CityObjects"]["house"]["geometry"][0]["lod"] == json(1.2));
  }

  TEST_CASE("a CityJSON 1.0 file can be taken apart into a stream that can be read") {
    const auto record = read_text(box_1_0());
    const CityJsonSplitter splitter(*record.value);
    const test::TemporaryFolder folder;
    const auto lines =
        test::read_all(folder.write("a.city.jsonl", splitter.header() + splitter.feature(0)));
    REQUIRE(lines.size() == 2);
    CHECK(codes_of(lines[1].issues) == "");
    CHECK(lines[1].value->buildings.at(0).lod == "2.2");
  }

  TEST_CASE("a CityJSONSeq needs its transform in every version") {
    const test::TemporaryFolder folder;
    const auto lines = test::read_all(folder.write(
        "a.city.jsonl", R"({"type":"CityJSON","version":"1.0","CityObjects":{},"vertices":[]})"));
    REQUIRE(lines.size() == 1);
    CHECK(codes_of(lines[0].issues) == "E201");
    CHECK(lines[0].issues[0].sentence == "has no 'transform', which a CityJSONSeq requires");
  }

  TEST_CASE("coordinates without a transform go on millimetres or else on micrometres") {
    const auto added = [](const std::string& vertices) {
      std::string text = " {\"a\":1,\"vertices\":" + vertices + "}\n";
      detail::add_transform(text);
      return text;
    };
    CHECK(added("[ [5.001, -2.5,0] ,[7,1,2e0]]") ==
          " {\"a\":1,\"vertices\":[[1,500,0],[2000,4000,2000]],"
          "\"transform\":{\"scale\":[0.001,0.001,0.001],\"translate\":[5,-3,0]}}\n");
    CHECK(added("[[5.00100004,0,0],[5.0000014,0,0.25]]") ==
          " {\"a\":1,\"vertices\":[[1000,0,0],[1,0,250000]],"
          "\"transform\":{\"scale\":[1e-06,1e-06,1e-06],\"translate\":[5,0,0]}}\n");
    CHECK(added("[]") ==
          " {\"a\":1,\"vertices\":[],"
          "\"transform\":{\"scale\":[0.001,0.001,0.001],\"translate\":[0,0,0]}}\n");
  }

  TEST_CASE("a vertex without a transform that is none costs the building that uses it") {
    const auto with_vertex = [](const std::string& vertex) {
      std::string text = box_1_0();
      const std::string first = "[1000.5,2000.25,10.0]";
      return codes_of(read_text(text.replace(text.find(first), first.size(), vertex)).issues);
    };
    CHECK(with_vertex("[1000.5,2000.25]") == "E202");
    CHECK(with_vertex("[1000.5,\"2000.25\",10]") == "E202");
    CHECK(with_vertex("null") == "E202");
    CHECK(with_vertex("[2e9,2000.25,10]") == "E506");
    CHECK(with_vertex("[1e300,2000.25,10]") == "E506");
    std::string text = box_1_0();
    CHECK(codes_of(read_text(text.replace(text.find("\"vertices\""), 10, "\"corners\"")).issues) ==
          "E201");
  }
}

}  // namespace
}  // namespace oriel
