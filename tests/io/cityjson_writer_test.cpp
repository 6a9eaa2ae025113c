#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <algorithm>
#include <stdexcept>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using nlohmann::json;
using test::BoxFile;

Document document_of(const std::string& text) {
  auto record = test::read_text(text);
  REQUIRE(record.value);
  return std::move(*record.value);
}

/// Walls, roof, ground, and the roof's face as a skylight of the east wall's face.
LabelledBuilding labels() {
  LabelledBuilding labelled;
  labelled.building = "house";
  labelled.surfaces = {
      {"GroundSurface", -1, FeatureLabel{.id = "g1"}},
      {"WallSurface", -1, {}},
      {"Window", 1,
       FeatureLabel{.label = "window",
                    .score = 0.75,
                    .others = {{"oriel_count", std::int64_t{3}}, {"oriel_sure", true}}}},
      {"Door", 1, {}}};
  labelled.surface_of_polygon = {0, 2, 1, 1, -1, 1};
  labelled.attributes = {{"oriel_version", std::string("0.1.0")}, {"oriel_scale", 0.1}};
  return labelled;
}

Installation chimney() {
  return {"c1", FeatureLabel{.class_code = "1000", .label = "chimney"}, {1, 2}, {2, 1}};
}

std::string check_valid(const std::string& text) {
  std::string faults;
  for (const std::string& fault : test::structural_faults(json::parse(text)))
    faults += fault + "; ";
  return faults;
}

/// Everything a file may hold that labels do not concern, oddly spaced and with odd numbers.
BoxFile rich_file() {
  BoxFile file;
  file.geometry = R"(, "material" : {"":{"values":[[0,0,null,0,0,0]]}})";
  file.building =
      R"(, "attributes" :{"height":1.50e1, "big" : 12345678901234567, "name":"a\/b\u00e9"} ,)"
      R"("address":[{"location":{"type":"MultiPoint","lod":"1","boundaries":[7]}}],"children" : [ "part" ])";
  file.objects =
      R"(, "part":{"type":"BuildingPart","parents":["house"],"geometry":[]},)"
      R"( "tree" : {"type":"SolitaryVegetationObject" ,"attributes":{"boundaries":[1,2]},"geometry":)"
      R"([{"type":"GeometryInstance","template":0,"boundaries":[ 6 ],"transformationMatrix":[1.0,0.0]}]} )";
  file.root =
      R"(,"appearance":{"materials":[{"name":"m","diffuseColor":[0.10,1.0,0.0]}]},)"
      R"( "extensions":{"E":{"url":"x","version":"1.0"}}, "+extra":[1.000, -0.0 ],)"
      R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}],)"
      R"("vertices-templates":[[0.50,0,0],[1,0,0],[0,1,0]]} )";
  return file;
}

TEST_SUITE("io") {
  TEST_CASE("a document without labels is written byte for byte") {
    const std::string text = "\r\n " + rich_file().text() + " \n";
    CHECK(write_cityjson(document_of(text), {}) == text);
  }

  TEST_CASE("labels become semantics with openings linked to their wall") {
    const std::string out = write_cityjson(document_of(BoxFile().text()), {labels()});
    CHECK(check_valid(out) == "");
    const json semantics = json::parse(out)["CityObjects"]["house"]["geometry"][0]["semantics"];
    CHECK(semantics["values"] == json::parse("[[0,2,1,1,null,1]]"));
    // The Door has no polygon and is left out.
    CHECK(semantics["surfaces"] == json::parse(R"([{"type":"GroundSurface","oriel_id":"g1"},
                          {"type":"WallSurface","children":[2]},
                          {"type":"Window","parent":1,"oriel_label":"window","oriel_score":0.75,
                           "oriel_count":3,"oriel_sure":true}])"));
  }

  TEST_CASE("labels leave the rest of the file as it is") {
    const std::string text = rich_file().text();
    LabelledBuilding labelled = labels();
    labelled.installations = {chimney()};
    const std::string out = write_cityjson(document_of(text), {labelled});
    CHECK(check_valid(out) == "");
    // Take away what was added, and the bytes are those of the input.
    std::string rest = out;
    const auto drop = [&](const std::string& from, const std::string& to) {
      const std::size_t start = rest.find(from);
      const std::size_t end = rest.find(to, start);
      REQUIRE(end != std::string::npos);
      rest.erase(start, end + to.size() - start);
    };
    drop(R"(,"c1":{)", R"([1,0]}}]})");
    drop(R"(,"semantics":{)", R"(1]]})");
    drop(R"(,"oriel_version")", R"("oriel_scale":0.1)");
    drop(R"(,"c1")", R"("c1")");
    CHECK(rest == text);
  }

  TEST_CASE("labelling twice gives the same bytes") {
    LabelledBuilding labelled = labels();
    labelled.installations = {chimney()};
    for (const std::string& text : {BoxFile().text(), rich_file().text()}) {
      const std::string once = write_cityjson(document_of(text), {labelled});
      CHECK(write_cityjson(document_of(once), {labelled}) == once);
    }
  }

  TEST_CASE("surfaces that are there keep their numbers and an opening finds its wall among them") {
    BoxFile file;
    file.geometry = R"(,"semantics":{"values":[[null,null,1,0,1]],"surfaces":[{"type":"Door"},)"
                    R"({"type":"WallSurface","colour":"red"}],"note":1})";
    LabelledBuilding labelled = labels();
    labelled.surface_of_polygon = {0, 2, 1, 1, 0, -1};
    const std::string out = write_cityjson(document_of(file.text()), {labelled});
    CHECK(check_valid(out) == "");
    const json semantics = json::parse(out)["CityObjects"]["house"]["geometry"][0]["semantics"];
    CHECK(semantics["values"] == json::parse("[[2,3,1,0,1,null]]"));
    CHECK(semantics["note"] == 1);
    CHECK(semantics["surfaces"][0] == json::parse(R"({"type":"Door"})"));
    CHECK(semantics["surfaces"][1] ==
          json::parse(R"({"type":"WallSurface","colour":"red","children":[3]})"));
    CHECK(semantics["surfaces"][3]["parent"] == 1);
    CHECK(write_cityjson(document_of(out), {labelled}) == out);
  }

  TEST_CASE("semantics of a wrong shape are written anew") {
    for (const char* semantics :
         {"3", "null", R"({"surfaces":[{"type":"RoofSurface"}],"values":[0,0]})",
          R"({"surfaces":[],"values":[[5,-1,"0"]]})", R"({"values":{}})"}) {
      BoxFile file;
      file.geometry = R"(,"semantics":)" + std::string(semantics);
      const std::string out = write_cityjson(document_of(file.text()), {labels()});
      CAPTURE(semantics);
      CHECK(check_valid(out) == "");
    }
  }

  TEST_CASE("values of a MultiSolid and of a MultiSurface have their shape") {
    BoxFile file;
    file.type = "MultiSolid";
    file.boundaries = "[[[[[0,3,2,1]],[[4,5,6,7]]],[[[0,1,5]]]],[[[[0,1,4]]]]]";
    LabelledBuilding labelled = labels();
    labelled.surface_of_polygon = {0, 2, 1, 1};
    std::string out = write_cityjson(document_of(file.text()), {labelled});
    CHECK(check_valid(out) == "");
    CHECK(out.find(R"("values":[[[0,2],[1]],[[1]]])") != std::string::npos);

    file.type = "MultiSurface";
    file.boundaries = "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5]]]";
    out = write_cityjson(document_of(file.text()), {labelled});
    CHECK(check_valid(out) == "");
    CHECK(out.find(R"("values":[0,2,1])") != std::string::npos);
  }

  TEST_CASE("an attribute of the same name is replaced and others stay") {
    BoxFile file;
    file.building = R"(,"attributes":{"oriel_version":{"old":[1]},"kept":1.0})";
    const std::string out = write_cityjson(document_of(file.text()), {labels()});
    CHECK(out.find(R"({"oriel_version":"0.1.0","kept":1.0,"oriel_scale":0.1})") !=
          std::string::npos);
  }

  TEST_CASE("an installation shares the vertices of its building and is linked to it") {
    LabelledBuilding labelled = labels();
    labelled.installations = {chimney()};
    const std::string out = write_cityjson(document_of(BoxFile().text()), {labelled});
    CHECK(check_valid(out) == "");
    const json file = json::parse(out);
    CHECK(file["CityObjects"]["house"]["children"] == json::parse(R"(["c1"])"));
    CHECK(file["CityObjects"]["c1"] == json::parse(R"({"type":"BuildingInstallation",
        "attributes":{"class":"1000","oriel_label":"chimney","oriel_geometry":"shared"},
        "parents":["house"],"geometry":[{"type":"MultiSurface","lod":"2.2",
        "boundaries":[[[4,5,6,7]],[[0,1,5,4]]],
        "semantics":{"surfaces":[{"type":"WallSurface","children":[1]},{"type":"Window","parent":0,
          "oriel_label":"window","oriel_score":0.75,"oriel_count":3,"oriel_sure":true}],
          "values":[1,0]}}]})"));
  }

  TEST_CASE("removed objects leave no link behind") {
    const std::string out =
        write_cityjson(document_of(rich_file().text()), {}, {.removed = {"part"}});
    CHECK(check_valid(out) == "");
    const json file = json::parse(out);
    CHECK_FALSE(file["CityObjects"].contains("part"));
    CHECK_FALSE(file["CityObjects"]["house"].contains("children"));
  }

  TEST_CASE("a feature of a CityJSONSeq stays one line") {
    const std::string header =
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],)"
        R"("translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
    const std::string feature =
        R"({"type":"CityJSONFeature","id":"house","CityObjects":{"house":{"type":"Building",)"
        R"("geometry":[{"type":"Solid","lod":"2","boundaries":)" +
        BoxFile().boundaries + R"(}]}},"vertices":)" + BoxFile().vertices + "}";
    const test::TemporaryFolder folder;
    const auto records = test::read_all(folder.write("a.jsonl", header + "\r\n\n" + feature));
    REQUIRE(records.size() == 2);
    CHECK(write_cityjson(*records[0].value, {}) == header + "\n");
    CHECK(write_cityjson(*records[1].value, {}) == feature + "\n");
    const std::string out = write_cityjson(*records[1].value, {labels()});
    CHECK(std::ranges::count(out, '\n') == 1);
    CHECK(test::structural_faults(json::parse(out), json::parse(header)).empty());
  }

  TEST_CASE("labels of a building that is not there are a mistake of the caller") {
    LabelledBuilding labelled;
    labelled.building = "other";
    CHECK_THROWS_AS(write_cityjson(document_of(BoxFile().text()), {labelled}), std::logic_error);
  }
}

}  // namespace
}  // namespace oriel
