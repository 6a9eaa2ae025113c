#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/io/solids.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using nlohmann::json;
using test::BoxFile;

Document read_document(const std::string& text) {
  auto record = test::read_text(text);
  REQUIRE(record.value);
  return std::move(*record.value);
}

/// The building "house" with a box as its geometry, in the frame of BoxFile (origin 1000 2000 10).
LabelledBuilding replaced(Vec3 min, Vec3 max) {
  LabelledBuilding labelled;
  labelled.building = "house";
  labelled.geometry.emplace();
  test::add_box(*labelled.geometry, min, max, 0);
  labelled.surfaces = {{"GroundSurface", -1, {}}, {"RoofSurface", -1, {}}};
  labelled.surface_of_polygon = {0, 1, -1, -1, -1, -1};
  return labelled;
}

void check_solids_valid(const std::string& text) {
  for (const std::string& fault : test::structural_faults(json::parse(text))) FAIL_CHECK(fault);
}

/// A neighbour that uses the last two vertices of the box and a point of its own.
BoxFile with_neighbour() {
  BoxFile file;
  file.vertices.insert(file.vertices.size() - 1, ",[9000,0,0],[9500,0,0]");
  file.building = R"(,"geographicalExtent":[0,0,0,1,1,1])";
  file.geometry = R"(,"material":{"":{"value":0}},"texture":{"t":{"values":[]}})";
  file.objects = R"(,"next":{"type":"Building","attributes":{"boundaries":[1,2]},)"
                 R"("address":[{"location":{"type":"MultiPoint","lod":"1","boundaries":[ 8 ]}}],)"
                 R"("geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[6, 7,9]]]}]})";
  return file;
}

TEST_SUITE("io") {
  TEST_CASE("a replaced geometry is a Solid with semantics by facet and unused vertices leave") {
    const Document document = read_document(with_neighbour().text());
    const std::string out = write_cityjson(document, {replaced({0.5, 0.25, 0}, {4.5, 3.25, 1.5})});
    check_solids_valid(out);
    const json file = json::parse(out);
    const json& geometry = file["CityObjects"]["house"]["geometry"][0];
    CHECK(geometry["type"] == "Solid");
    CHECK(geometry["lod"] == "2.2");
    CHECK_FALSE(geometry.contains("material"));
    CHECK_FALSE(geometry.contains("texture"));
    CHECK_FALSE(file["CityObjects"]["house"].contains("geographicalExtent"));
    CHECK(geometry["semantics"]["values"] == json::parse("[[0,1,null,null,null,null]]"));
    // The four of the ground stay, the two that the neighbour shares, its own two, and four new
    // ones.
    CHECK(file["vertices"] ==
          json::parse("[[0,0,0],[4000,0,0],[4000,3000,0],[0,3000,0],"
                      "[4000,3000,2000],[0,3000,2000],[9000,0,0],[9500,0,0],"
                      "[0,0,1500],[4000,0,1500],[4000,3000,1500],[0,3000,1500]]"));
    CHECK(geometry["boundaries"][0][0] == json::parse("[[0,3,2,1]]"));
    const json& next = file["CityObjects"]["next"];
    CHECK(next["geometry"][0]["boundaries"] == json::parse("[[[4,5,7]]]"));
    CHECK(next["address"][0]["location"]["boundaries"] == json::parse("[6]"));
    CHECK(next["attributes"]["boundaries"] == json::parse("[1,2]"));
    CHECK(file["transform"] == json::parse(BoxFile().transform));
  }

  TEST_CASE("what is written reads back to the same solid") {
    const Document document = read_document(BoxFile().text());
    const std::string out = write_cityjson(document, {replaced({0.5, 0.25, 0}, {4.5, 3.25, 1.5})});
    const Document again = read_document(out);
    Box box;
    for (const Vec3 p : again.buildings.at(0).vertices)
      box.grow(p + again.buildings[0].frame.origin_m);
    CHECK(box.min == Vec3{1000.5, 2000.25, 10});
    CHECK(box.max == Vec3{1004.5, 2003.25, 11.5});
    CHECK(again.buildings[0].polygons.size() == 6);
  }

  TEST_CASE("several lumps become a MultiSolid and cavities inner shells") {
    LabelledBuilding labelled = replaced({0, 0, 0}, {4, 3, 2});
    test::add_box(*labelled.geometry, {1, 1, 0.5}, {2, 2, 1}, 0, true);
    test::add_box(*labelled.geometry, {10, 0, 0}, {12, 2, 2}, 1);
    // Shells may come in any order.
    std::swap(labelled.geometry->shells[0], labelled.geometry->shells[1]);
    labelled.surface_of_polygon.resize(18, 0);
    const std::string out = write_cityjson(read_document(BoxFile().text()), {labelled});
    check_solids_valid(out);
    const json geometry = json::parse(out)["CityObjects"]["house"]["geometry"][0];
    CHECK(geometry["type"] == "MultiSolid");
    CHECK(geometry["boundaries"].size() == 2);
    CHECK(geometry["boundaries"][0].size() == 2);
    CHECK(geometry["semantics"]["values"] ==
          json::parse("[[[0,1,null,null,null,null],[0,0,0,0,0,0]],[[0,0,0,0,0,0]]]"));
    labelled.geometry->shells.erase(labelled.geometry->shells.begin() + 2);
    CHECK(json::parse(write_cityjson(read_document(BoxFile().text()),
                                     {labelled}))["CityObjects"]["house"]["geometry"][0]["type"] ==
          "Solid");
  }

  TEST_CASE("a coarse scale becomes finer for the whole file and old coordinates stay exact") {
    BoxFile file = with_neighbour();
    file.transform = R"({"scale":[0.01,0.01,0.01],"translate":[1000.5,2000.25,10.0]})";
    const Document document = read_document(file.text());
    LabelledBuilding labelled = replaced({0.5, 0.25, 0}, {4.5, 3.25, 1.503});
    const std::string out = write_cityjson(document, {labelled});
    check_solids_valid(out);
    const json written = json::parse(out);
    CHECK(written["transform"]["scale"] == json::parse("[0.001,0.001,0.001]"));
    CHECK(written["vertices"].dump().find("[90000,0,0]") != std::string::npos);
    CHECK(written["vertices"].dump().find("[0,0,1503]") != std::string::npos);
  }

  TEST_CASE("the grid of a file is the same whatever is written") {
    // Vertices that are one on this grid ask for no finer one: their neighbours would move.
    LabelledBuilding labelled = replaced({0.5, 0.25, 0}, {4.5, 3.25, 0.0004});
    const json written = json::parse(write_cityjson(read_document(BoxFile().text()), {labelled}));
    CHECK(written["transform"] == json::parse(BoxFile().transform));
    CHECK(written["vertices"].size() == 4);
  }

  TEST_CASE("a line of a CityJSONSeq keeps the transform of its header") {
    const std::string header =
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.01,0.01,0.01],)"
        R"("translate":[1000.5,2000.25,10.0]},"CityObjects":{},"vertices":[]})";
    const std::string feature =
        R"({"type":"CityJSONFeature","id":"house","CityObjects":{"house":{"type":"Building",)"
        R"("geometry":[{"type":"Solid","lod":"2","boundaries":)" +
        BoxFile().boundaries + R"(}]}},"vertices":)" + BoxFile().vertices + "}";
    const test::TemporaryFolder folder;
    const auto records = test::read_all(folder.write("a.jsonl", header + "\n" + feature));
    REQUIRE(records.size() == 2);
    // A facet less than the scale high vanishes with its edges.
    const std::string out =
        write_cityjson(*records[1].value, {replaced({0.5, 0.25, 0}, {4.5, 3.25, 0.004})});
    CHECK(test::structural_faults(json::parse(out), json::parse(header)).empty());
    CHECK(std::ranges::count(out, '\n') == 1);
    CHECK(json::parse(out)["CityObjects"]["house"]["geometry"][0]["boundaries"][0].size() == 2);
  }

  TEST_CASE("an installation of a replaced geometry is made of its facets") {
    LabelledBuilding labelled = replaced({0.5, 0.25, 0}, {4.5, 3.25, 1.5});
    labelled.installations = {{"i1", {}, {1, 3}, {1, -1}}};
    const std::string out = write_cityjson(read_document(with_neighbour().text()), {labelled});
    check_solids_valid(out);
    const json file = json::parse(out);
    CHECK(file["CityObjects"]["i1"]["geometry"][0]["boundaries"][0] ==
          file["CityObjects"]["house"]["geometry"][0]["boundaries"][0][1]);
    CHECK(file["CityObjects"]["i1"]["geometry"][0]["semantics"]["values"] ==
          json::parse("[0,null]"));
  }
}

}  // namespace
}  // namespace oriel
