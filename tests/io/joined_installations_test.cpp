#include "io/cityjson/carried_labels.h"
#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/support/citygml_samples.h"

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using nlohmann::json;
using test::BoxFile;
using test::codes_of;
using test::read_text;

ReadOptions joining(bool is_joining = true) {
  ReadOptions options;
  options.joins_installations = is_joining;
  return options;
}

/// A chimney of two polygons on the roof of the box, and one that shares polygons of the box.
BoxFile with_chimney(const std::string& lod = R"("2.2")", const std::string& more = "") {
  BoxFile file;
  file.building = R"(,"children":["chimney","shared"])";
  file.objects =
      R"(,"chimney":{"type":"BuildingInstallation","parents":["house"],"attributes":{"a":1},)"
      R"("geometry":[{"type":"MultiSurface","lod":)" +
      lod + R"(,"boundaries":[[[4,5,8]],[[5,8,8,9]]])" + more +
      R"(}]},"shared":{"type":"BuildingInstallation","parents":["house"],)"
      R"("attributes":{"oriel_geometry":"shared"},"geometry":[{"type":"MultiSurface","lod":"2.2",)"
      R"("boundaries":[[[4,5,6,7]]]}]})";
  file.vertices.insert(file.vertices.size() - 1, ",[500,500,3000],[-700,500,-2500]");
  return file;
}

LabelledBuilding roof_labels() {
  LabelledBuilding labelled;
  labelled.building = "house";
  labelled.surface_of_polygon = {-1, 0, -1, -1, -1, -1, -1, 1};
  labelled.surfaces = {{"RoofSurface", -1, {}}, {"WallSurface", -1, {}}};
  return labelled;
}

TEST_SUITE("io") {
  TEST_CASE("a building that installations were joined to is the one without them again") {
    const Building joined =
        read_text(with_chimney().text(), "a.city.json", joining()).value->buildings.at(0);
    const Building alone =
        read_text(with_chimney().text(), "a.city.json", joining(false)).value->buildings.at(0);
    REQUIRE(joined.installations.size() == 1);
    const Building again = without_installations(joined);
    CHECK(again.installations.empty());
    CHECK(again.repeats.empty());
    CHECK(again.frame.origin_m == alone.frame.origin_m);
    CHECK(again.vertices == alone.vertices);
    REQUIRE(again.polygons.size() == alone.polygons.size());
    for (std::size_t p = 0; p < again.polygons.size(); ++p)
      CHECK(again.polygons[p].rings == alone.polygons[p].rings);
    CHECK(without_installations(alone).vertices == alone.vertices);
  }

  TEST_CASE("the polygons of an installation stand behind those of its building") {
    const auto alone = read_text(with_chimney().text(), "a.city.json", joining(false));
    CHECK(alone.value->buildings.at(0).polygons.size() == 6);
    CHECK(alone.value->buildings[0].installations.empty());
    const auto record = read_text(with_chimney().text(), "a.city.json", joining());
    CHECK(codes_of(record.issues) == "E312");
    REQUIRE(record.value);
    REQUIRE(record.value->buildings.size() == 1);
    const Building& building = record.value->buildings[0];
    CHECK(building.is_solid);
    REQUIRE(building.polygons.size() == 8);
    REQUIRE(building.installations.size() == 1);
    CHECK(building.installations[0].id == "chimney");
    CHECK(building.installations[0].first_polygon == 6);
    CHECK(building.polygons[5].body == 0);
    // What touches is cut within a body only.
    CHECK(building.polygons[6].body == 0);
    CHECK(building.polygons[7].source == 7);
    CHECK(building.vertices.size() == 10);
    CHECK(building.installations[0].first_vertex == 8);
    // The frame is that of its own polygons.
    CHECK(building.frame.origin_m == Vec3{1000, 2000, 10});
    const auto place = [&](int vertex) {
      return building.vertices[static_cast<std::size_t>(vertex)] + building.frame.origin_m;
    };
    const auto& ring = building.polygons[7].rings[0];
    REQUIRE(ring.size() == 3);
    CHECK(place(ring[0]) == Vec3{1004.5, 2000.25, 12});
    CHECK(place(ring[1]) == Vec3{1001, 2000.75, 13});
    CHECK(place(ring[2]) == Vec3{999.8, 2000.75, 7.5});
    REQUIRE(building.repeats.size() == 1);
    CHECK(building.repeats[0].polygon == 7);
    CHECK(building.repeats[0].vertex == ring[1]);
  }

  TEST_CASE("an installation of another level of detail is not joined") {
    const auto record = read_text(with_chimney(R"("3")").text(), "a.city.json", joining());
    CHECK(codes_of(record.issues) == "");
    CHECK(record.value->buildings.at(0).lod == "2.2");
    CHECK(record.value->buildings[0].polygons.size() == 6);
  }

  TEST_CASE("an installation whose polygons the building has all is not joined") {
    BoxFile file = with_chimney();
    const std::string own = "[[[4,5,8]],[[5,8,8,9]]]";
    file.objects.replace(file.objects.find(own), own.size(), "[[[5,6,7,4]],[[4,5,1,0]]]");
    const auto record = read_text(file.text(), "a.city.json", joining());
    CHECK(codes_of(record.issues) == "");
    CHECK(record.value->buildings.at(0).polygons.size() == 6);
    CHECK(record.value->buildings[0].installations.empty());
    file.objects.replace(file.objects.find("[4,5,1,0]"), 9, "[4,5,1,3]");
    const auto other = read_text(file.text(), "a.city.json", joining());
    CHECK(other.value->buildings.at(0).polygons.size() == 8);
  }

  TEST_CASE("an installation with a fault is left out with a warning") {
    BoxFile file = with_chimney();
    file.objects.replace(file.objects.find("[4,5,8]"), 7, "[4,5,99]");
    const auto record = read_text(file.text(), "a.city.json", joining());
    CHECK(codes_of(record.issues) == "E203");
    CHECK_FALSE(has_errors(record.issues));
    CHECK(record.issues[0].sentence.starts_with("installation 'chimney': "));
    const Building& building = record.value->buildings.at(0);
    CHECK(building.polygons.size() == 6);
    CHECK(building.vertices.size() == 8);
    CHECK(building.frame.origin_m == Vec3{1000, 2000, 10});
  }

  TEST_CASE("each polygon is written back once and to the object that it came from") {
    const std::string semantics =
        R"(,"semantics":{"surfaces":[{"type":"RoofSurface","own":1}],"values":[0,null]})";
    const auto record =
        read_text(with_chimney(R"("2.2")", semantics).text(), "a.city.json", joining());
    const std::string out = write_cityjson(*record.value, {roof_labels()});
    const json file = json::parse(out);
    for (const std::string& fault : test::structural_faults(file)) FAIL_CHECK(fault);
    const json& objects = file["CityObjects"];
    CHECK(objects.size() == 3);
    const json& house = objects["house"]["geometry"][0];
    CHECK(house["boundaries"][0].size() == 6);
    CHECK(house["semantics"]["values"] == json::parse("[[null,0,null,null,null,null]]"));
    CHECK(house["semantics"]["surfaces"] == json::parse(R"([{"type":"RoofSurface"}])"));
    const json& chimney = objects["chimney"];
    CHECK(chimney["attributes"] == json{{"a", 1}});
    CHECK(chimney["geometry"][0]["boundaries"] == json::parse("[[[4,5,8]],[[5,8,8,9]]]"));
    CHECK(chimney["geometry"][0]["semantics"] ==
          json::parse(R"({"surfaces":[{"type":"RoofSurface","own":1},{"type":"WallSurface"}],)"
                      R"("values":[0,1]})"));
    CHECK(write_cityjson(*record.value, {}) == with_chimney(R"("2.2")", semantics).text());
    const auto again = read_text(out, "a.city.json", joining());
    CHECK(write_cityjson(*again.value, {roof_labels()}) == out);
  }

  TEST_CASE("a feature may have polygons of a building and of what stands on it") {
    const auto record = read_text(with_chimney().text(), "a.city.json", joining());
    LabelledBuilding labelled = roof_labels();
    labelled.attributes = {{"oriel_pack", std::string("p")}};
    labelled.installations = {
        {"c1",
         FeatureLabel{
             .id = "c1", .label = "chimney", .subclass = "flue", .score = 0.5, .rule = "r"},
         {1, 6, 7},
         {0, -1, 1}}};
    const std::string out = write_cityjson(*record.value, {labelled});
    const json file = json::parse(out);
    for (const std::string& fault : test::structural_faults(file)) FAIL_CHECK(fault);
    CHECK(file["CityObjects"]["c1"]["geometry"][0]["boundaries"] ==
          json::parse("[[[4,5,6,7]],[[4,5,8]],[[5,8,8,9]]]"));
    const auto again = read_text(out, "a.city.json", joining());
    CHECK(again.value->buildings.at(0).polygons.size() == 8);
    const auto carried = CarriedLabelReader(*again.value).labels_of(0);
    REQUIRE(carried);
    REQUIRE(carried->features.size() == 1);
    CHECK(carried->features[0].said == *labelled.installations[0].label);
    CHECK(carried->features[0].polygons == std::vector<int>{1, 6, 7});
    REQUIRE(carried->types.size() == 8);
    CHECK(carried->types[1] == "RoofSurface");
    CHECK(carried->types[7] == "WallSurface");
  }

  TEST_CASE("installations of CityGML are joined as those of CityJSON are") {
    using namespace test;
    const std::string chimney = element(
        "bldg:outerBuildingInstallation",
        element("bldg:BuildingInstallation",
                element("bldg:lod2Geometry",
                        multi_surface(surface_member(polygon("", "0 0 0 4 0 0 0 3 0 0 0 0")))),
                "gml:id=\"chimney\""));
    const TemporaryFolder folder;
    const auto records = read_all(
        folder.write(
            "a.gml",
            CityGmlFile{"2.0", building("house", box_by_links("2.0", "p") + chimney)}.text()),
        joining());
    REQUIRE(records.size() == 2);
    const Building& house = records[1].value->buildings.at(0);
    CHECK(house.polygons.size() == 7);
    REQUIRE(house.installations.size() == 1);
    CHECK(house.installations[0].id == "chimney");
  }

  TEST_CASE("a part takes its own installations and not those of its sibling") {
    BoxFile file = with_chimney();
    file.building = R"(,"children":["part"])";
    file.objects.replace(file.objects.find("[\"house\"]"), 9, "[\"part\"]");
    file.objects += R"(,"part":{"type":"BuildingPart","parents":["house"],"children":["chimney"],)"
                    R"("geometry":[{"type":"Solid","lod":"2.2","boundaries":)" +
                    file.boundaries + "}]}";
    const auto record = read_text(file.text(), "a.city.json", joining());
    REQUIRE(record.value->buildings.size() == 2);
    CHECK(record.value->buildings[0].installations.empty());
    CHECK(record.value->buildings[1].installations.size() == 1);
  }
}

}  // namespace
}  // namespace oriel
