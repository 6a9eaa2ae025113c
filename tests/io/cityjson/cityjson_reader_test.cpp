#include "io/reader.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel {
namespace {

using test::BoxFile;
using test::codes_of;
using test::read_text;

TEST_SUITE("io") {
  TEST_CASE("a Solid becomes polygons in the frame of its building") {
    BoxFile file;
    file.root = R"(,"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"})";
    const auto record = read_text(file.text());
    CHECK(record.issues.empty());
    REQUIRE(record.value);
    CHECK(record.value->format == Format::cityjson);
    REQUIRE(record.value->buildings.size() == 1);
    const Building& building = record.value->buildings[0];
    CHECK(building.id == "house");
    CHECK(building.lod == "2.2");
    CHECK(building.is_solid);
    CHECK(building.frame.origin_m == Vec3{1000, 2000, 10});
    CHECK(building.frame.crs == "https://www.opengis.net/def/crs/EPSG/0/7415");
    REQUIRE(building.polygons.size() == 6);
    CHECK(building.vertices.size() == 8);
    // The ring of the ground names the file's vertices 0 3 2 1.
    CHECK(building.polygons[0].rings == std::vector<std::vector<int>>{{0, 1, 2, 3}});
    CHECK(building.vertices[1] == Vec3{0.5, 3.25, 0});
    for (int i = 0; i < 6; ++i) {
      CHECK(building.polygons[static_cast<std::size_t>(i)].source == i);
      CHECK(building.polygons[static_cast<std::size_t>(i)].shell == 0);
    }
  }

  TEST_CASE("the shells of a MultiSolid are numbered within their bodies") {
    BoxFile file;
    file.type = "MultiSolid";
    file.boundaries = "[[[[[0,3,2]],[[0,1,5]]],[[[1,2,6]]]],[[[[2,3,7],[4,5,6]],[[4,5,6]]]]]";
    const auto record = read_text(file.text());
    REQUIRE(record.value);
    const auto& polygons = record.value->buildings.at(0).polygons;
    REQUIRE(polygons.size() == 5);
    const auto place = [&](std::size_t i) {
      return std::pair(polygons[i].body, polygons[i].shell);
    };
    CHECK(place(0) == std::pair(0, 0));
    CHECK(place(2) == std::pair(0, 1));
    CHECK(place(3) == std::pair(1, 0));
    CHECK(polygons[3].rings.size() == 2);
    CHECK(polygons[4].source == 4);
  }

  TEST_CASE("loose surfaces are no solid") {
    for (const char* type : {"MultiSurface", "CompositeSurface"}) {
      BoxFile file;
      file.type = type;
      file.boundaries = "[[[0,3,2,1]],[[4,5,6,7]]]";
      const auto record = read_text(file.text());
      REQUIRE(record.value);
      CHECK_FALSE(record.value->buildings.at(0).is_solid);
    }
  }

  TEST_CASE("semantic surfaces are hints and null stands for all it contains") {
    BoxFile file;
    file.geometry =
        R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"Window","parent":0}],)"
        R"("values":[[0,null,1,1,null,0]]})";
    const auto record = read_text(file.text());
    CHECK(record.issues.empty());
    const auto& polygons = record.value->buildings.at(0).polygons;
    CHECK(polygons[0].hint == "GroundSurface");
    CHECK(polygons[1].hint.empty());
    CHECK(polygons[3].hint == "Window");

    file.geometry = R"(,"semantics":{"surfaces":[{"type":"GroundSurface"}],"values":[null]})";
    const auto empty = read_text(file.text());
    CHECK(empty.issues.empty());
    CHECK(empty.value->buildings.at(0).polygons[0].hint.empty());
  }

  TEST_CASE("semantics that do not fit are a warning and cost nothing else") {
    for (const char* values :
         {"[[0,0,0,0,0,0,0]]", "[[0]]", "[[7,0,0,0,0,0]]", "[0]", "3", R"([["0",0,0,0,0,0]])"}) {
      BoxFile file;
      file.geometry = R"(,"semantics":{"surfaces":[{"type":"RoofSurface"}],"values":)" +
                      std::string(values) + "}";
      const auto record = read_text(file.text());
      CAPTURE(values);
      CHECK(codes_of(record.issues) == "E208");
      CHECK(record.issues.at(0).severity == Severity::warning);
      CHECK(record.value->buildings.size() == 1);
    }
  }

  /// A footprint on the Building and two Solids on its part.
  std::string family() {
    BoxFile file;
    file.type = "MultiSurface";
    file.lod = R"("0")";
    file.boundaries = "[[[0,3,2,1]]]";
    file.building = R"(,"children":["part"])";
    file.objects =
        R"(,"part":{"type":"BuildingPart","parents":["house"],"geometry":[)"
        R"({"type":"Solid","lod":"1.2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]]]]},)"
        R"({"type":"MultiSurface","lod":"2","boundaries":[[[0,3,2,1]]]},)"
        R"({"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]]]]}]})";
    return file.text();
  }

  TEST_CASE(
      "without a level of detail the highest of the family is taken and a solid before surfaces") {
    const auto record = read_text(family());
    REQUIRE(record.value);
    REQUIRE(record.value->buildings.size() == 1);
    CHECK(record.value->buildings[0].id == "part");
    CHECK(record.value->buildings[0].lod == "2");
    CHECK(record.value->buildings[0].polygons.size() == 3);
    CHECK(codes_of(record.issues) == "E205 E215");
    CHECK(record.issues[0].severity == Severity::note);
    CHECK(record.issues[0].place.building == "house");
    CHECK(record.issues[1].place.building == "part");
  }

  TEST_CASE("a level of detail asked for is taken exactly") {
    const auto record = read_text(family(), "a.json", {"1.2", {}});
    REQUIRE(record.value->buildings.size() == 1);
    CHECK(record.value->buildings[0].polygons.size() == 2);
    const auto footprint = read_text(family(), "a.json", {"0", {}});
    REQUIRE(footprint.value->buildings.size() == 1);
    CHECK(footprint.value->buildings[0].id == "house");
  }

  TEST_CASE("a byte order mark and CRLF are accepted") {
    std::string text = BoxFile().text();
    for (std::size_t at = text.find(','); at != std::string::npos; at = text.find(',', at + 3))
      text.insert(at + 1, "\r\n");
    const auto record = read_text("\xEF\xBB\xBF" + text);
    CHECK(record.issues.empty());
    CHECK(record.value->buildings.size() == 1);
  }

  /// A CityJSONSeq with two boxes, lines ended by `end`.
  std::string sequence(const std::string& end) {
    const std::string box = BoxFile().boundaries;
    const auto feature = [&](const std::string& id) {
      return R"({"type":"CityJSONFeature","id":")" + id + R"(","CityObjects":{")" + id +
             R"(":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":)" + box +
             R"(}]}},"vertices":)" + BoxFile().vertices + "}" + end;
    };
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)"
           R"("translate":[85000.5,446000.0,0.0]},"CityObjects":{},"vertices":[]})" +
           end + feature("a") + end + feature("b");
  }

  TEST_CASE("a CityJSONSeq gives its header and then one record a line") {
    const test::TemporaryFolder folder;
    for (const char* end : {"\n", "\r\n"}) {
      const auto records = test::read_all(folder.write("t.city.jsonl", sequence(end)));
      REQUIRE(records.size() == 3);
      CHECK(records[0].value->buildings.empty());
      CHECK(records[1].value->buildings.at(0).id == "a");
      CHECK(records[1].value->buildings[0].frame.origin_m == Vec3{85000, 446000, 0});
      CHECK(records[2].value->name.ends_with("t.city.jsonl:4"));
      for (const auto& record : records) CHECK(record.issues.empty());
    }
  }

  TEST_CASE("a broken line of a CityJSONSeq costs that line only") {
    const test::TemporaryFolder folder;
    std::string text = sequence("\n");
    text.replace(text.find(R"("id":"a")"), 8, R"("id":!a")");
    const auto records = test::read_all(folder.write("t.city.jsonl", text));
    REQUIRE(records.size() == 3);
    CHECK_FALSE(records[1].value);
    CHECK(codes_of(records[1].issues) == "E104");
    CHECK(records[1].issues[0].place.line == 2);
    CHECK(records[1].issues[0].place.column == 32);
    CHECK(records[2].value->buildings.at(0).id == "b");
  }

  TEST_CASE("ids may be escaped") {
    std::string text = BoxFile().text();
    text.replace(text.find("house"), 5, R"(Caf\u00e9 \"1\")");
    const auto record = read_text(text);
    CHECK(record.value->buildings.at(0).id == "Café \"1\"");
  }

  TEST_CASE("an object that is no JSON refuses the file with its place") {
    const std::string objects = R"("CityObjects":{)";
    for (const char* broken :
         {R"({"type":"Building"}5)", "", R"({"type":})", R"({"type":"Road"])", "[{}", "tru", "{}{}",
          R"({"boundaries":[[[1}]})", R"("Road)", R"({"type":"Ro\ad"})"}) {
      CAPTURE(broken);
      std::string text = BoxFile().text();
      const std::size_t at = text.find(objects) + objects.size();
      text.insert(at, fmt::format(R"("broken":{},)", broken));
      const auto record = read_text(text);
      CHECK_FALSE(record.value);
      REQUIRE(record.issues.size() == 1);
      CHECK((record.issues[0].code == Code::E104 || record.issues[0].code == Code::E105));
      CHECK(record.issues[0].place.line > 0);
    }
  }

  TEST_CASE("a member that is no CityObject costs itself") {
    const std::string objects = R"("CityObjects":{)";
    for (const char* member : {"5", "null", R"("text")", "[]", "[{}]", R"({"type":4})"}) {
      CAPTURE(member);
      std::string text = BoxFile().text();
      text.insert(text.find(objects) + objects.size(), fmt::format(R"("odd":{},)", member));
      for (const char* key : {R"("CityObjects")", R"("CityObj\u0065cts")"}) {
        text.replace(text.find(R"("CityObj)"),
                     text.find(':', text.find(R"("CityObj)")) - text.find(R"("CityObj)"), key);
        const auto record = read_text(text);
        REQUIRE(record.value);
        CHECK(record.value->buildings.size() == 1);
        REQUIRE(record.issues.size() == 1);
        CHECK(record.issues[0].place.building == "odd");
      }
    }
  }
}

}  // namespace
}  // namespace oriel
