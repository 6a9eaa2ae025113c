#include "io/mesh/mesh_writer.h"
#include "io/writer.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/support/citygml_samples.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// Reads a text under that name and writes what came of it; the test is that this ends.
void read_and_write(const test::TemporaryFolder& folder, const std::string& name,
                    const std::string& text) {
  for (const auto& record : test::read_all(folder.write(name, text))) {
    CHECK((record.value || has_errors(record.issues)));
    if (!record.value) continue;
    std::vector<LabelledBuilding> labelled;
    for (const Building& building : record.value->buildings) {
      LabelledBuilding& one = labelled.emplace_back();
      one.building = building.id;
      one.surfaces = {{"WallSurface", -1, {}}, {"Window", 0, FeatureLabel{.id = "w"}}};
      one.surface_of_polygon.assign(building.polygons.size(), 1);
      one.installations = {{"i", FeatureLabel{.class_code = "1000"}, {0}, {1}}};
    }
    // Of a CityGML building that could not be read nothing is written.
    if (record.value->format == Format::citygml && !record.value->source) continue;
    CHECK_FALSE(write_cityjson(*record.value, labelled, {.removed = {"gone"}}).empty());
    MeshSource mesh;
    append_mesh(mesh, *record.value, labelled);
    CHECK_FALSE(write_obj(mesh).empty());
    CHECK_FALSE(write_off(mesh).empty());
  }
}

/// Every prefix of `text`, and `text` with each byte replaced by each of a few nasty ones.
void try_corruptions(const std::string& name, const std::string& text) {
  const test::TemporaryFolder folder;
  for (std::size_t size = 0; size <= text.size(); ++size)
    read_and_write(folder, name, text.substr(0, size));
  for (std::size_t at = 0; at < text.size(); ++at)
    for (const char byte :
         {'\0', '"', '[', '}', ',', '9', '-', '\\', ' ', '\n', '\xFF', '<', '#', '&'}) {
      std::string corrupt = text;
      corrupt[at] = byte;
      read_and_write(folder, name, corrupt);
    }
}

TEST_SUITE("io") {
  TEST_CASE("no truncation and no corrupt byte of a CityJSON file is fatal") {
    test::BoxFile file;
    file.geometry = R"(,"semantics":{"surfaces":[{"type":"Door"}],"values":[[0,null]]})";
    file.building = R"(,"attributes":{"a":"\u00e9\\"},"children":["x"])";
    try_corruptions("a.city.json", file.text());
  }

  TEST_CASE("no truncation and no corrupt byte of a CityJSONSeq is fatal") {
    try_corruptions("a.city.jsonl",
                    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],)"
                    R"("translate":[0,0,0]},"CityObjects":{},"vertices":[]})"
                    "\n"
                    R"({"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"Building",)"
                    R"("geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}]}},)"
                    R"("vertices":[[0,0,0],[1,0,0],[0,1,0]]})"
                    "\n");
  }

  TEST_CASE("no truncation and no corrupt byte of a CityGML file is fatal") {
    const std::string triangle = "0 0 0 1 0 0 0 1 0 0 0 0";
    const std::string wall =
        test::multi_surface(test::surface_member(test::polygon("p", triangle)));
    try_corruptions(
        "a.gml",
        test::CityGmlFile{
            "2.0",
            test::building(
                "a",
                test::element("gen:intAttribute", test::element("gen:value", "1"), "name=\"n\"") +
                    test::element("bldg:boundedBy",
                                  test::element("bldg:WallSurface",
                                                test::element("bldg:lod2MultiSurface", wall))) +
                    test::element("bldg:lod2Solid", test::solid(test::link_to("p"))))}
            .text());
  }

  TEST_CASE("no truncation and no corrupt byte of a mesh file is fatal") {
    try_corruptions("a.obj",
                    "# c\no house\nv 0 0 0\nv 1 0 0\nv 0 1.5e0 0\nv 0 0 1\nusemtl brick\n"
                    "f 1//1 2//1 3\nf -1 -2 \\\n-3\ng roof\nf 1/1/1 2 4\n");
    try_corruptions("a.off",
                    "OFF # c\n4 3 0\n0 0 0\n1 0 0\n0 1.5e0 0\n0 0 1\n3 0 1 2\n"
                    "3 1 2 3 255 0 0\n3 0 2 3\n");
    try_corruptions("a.ply",
                    "ply\nformat ascii 1.0\ncomment feature 0 a roof\nelement vertex 4\n"
                    "property float x\nproperty float y\nproperty double z\nelement face 2\n"
                    "property list uchar int vertex_indices\nproperty int feature\nend_header\n"
                    "0 0 0\n1 0 0\n0 1.5e0 0\n0 0 1\n3 0 1 2 0\n3 1 2 3 -1\n");
  }
}

}  // namespace
}  // namespace oriel
