#include "io/mesh/mesh_writer.h"

#include "io/writer.h"
#include "tests/io/cityjson_checks.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"
#include "tests/io/solids.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxFile;

Document house_of(const std::string& text, const std::string& name = "house.city.json") {
  auto record = test::read_text(text, name);
  REQUIRE(record.value);
  return std::move(*record.value);
}

MeshSource mesh_of(const Document& document, const std::vector<LabelledBuilding>& labelled = {}) {
  MeshSource mesh;
  append_mesh(mesh, document, labelled);
  return mesh;
}

/// A wall of 4 × 3 m in UTM coordinates with a hole, and an L-shaped floor.
std::string walls() {
  BoxFile file;
  file.type = "MultiSurface";
  file.transform = R"({"scale":[0.001,0.001,0.001],"translate":[678114.444,5403766.115,414.03]})";
  file.vertices =
      "[[0,0,0],[4000,0,0],[4000,0,3000],[0,0,3000],[1000,0,1000],[1000,0,2000],[2000,0,2000],"
      "[2000,0,1000],[2000,-2000,0],[4000,-2000,0],[2000,-1000,0],[0,-1000,0]]";
  file.boundaries = "[[[0,1,2,3],[4,5,6,7]],[[0,11,10,8,9,1]]]";
  return file.text();
}

std::vector<Vec3> input_points(const Document& document) {
  std::vector<Vec3> points;
  for (const Polygon& polygon : document.buildings.at(0).polygons)
    for (const auto& ring : polygon.rings)
      for (const int v : ring)
        points.push_back(document.buildings[0].vertices[static_cast<std::size_t>(v)] +
                         document.buildings[0].frame.origin_m);
  return points;
}

LabelledBuilding box_labels() {
  LabelledBuilding labelled;
  labelled.building = "house";
  labelled.surfaces = {{"WallSurface", -1, {}},
                       {"Window", 0, FeatureLabel{.id = "w 1", .label = "window"}}};
  labelled.surface_of_polygon = {-1, 0, 0, 1, 1, 0};
  labelled.installations = {{"c1", FeatureLabel{.label = "chimney"}, {4, 5}, {1, 0}}};
  return labelled;
}

TEST_SUITE("io") {
  TEST_CASE("OBJ and OFF and PLY keep UTM coordinates to the last bit") {
    const std::string obj =
        "v 678114.444 5403766.115 414.03\nv 678115.4440001 5403766.115 414.03\n"
        "v 678114.444 5403767.115 414.03\nf 1 2 3\n";
    const Document document = house_of(obj, "a.obj");
    const std::string text = write_obj(mesh_of(document));
    CHECK(text.find("v 678114.444 5403766.115 414.03\n") != std::string::npos);
    CHECK(text.find("v 678115.4440001 5403766.115 414.03\n") != std::string::npos);
    CHECK(input_points(house_of(text, "a.obj")) == input_points(document));
    const std::string off = write_off(mesh_of(document));
    CHECK(input_points(house_of(off, "a.off")) == input_points(document));
    const std::string ply = write_ply(mesh_of(document));
    CHECK(input_points(house_of(ply, "a.ply")) == input_points(document));
    CHECK(write_stl(mesh_of(document)).find("vertex 678115.4440001 5403766.115 414.03\n") !=
          std::string::npos);
  }

  TEST_CASE("faces with holes are triangulated and simple ones kept in OBJ") {
    const Document again = house_of(write_obj(mesh_of(house_of(walls()))), "a.obj");
    const auto& polygons = again.buildings.at(0).polygons;
    CHECK(polygons.size() == 9);
    CHECK(std::ranges::count_if(polygons,
                                [](const Polygon& p) { return p.rings[0].size() == 6; }) == 1);
  }

  TEST_CASE("faces that are not convex are triangulated in OFF") {
    const Document again = house_of(write_off(mesh_of(house_of(walls()))), "a.off");
    const auto& polygons = again.buildings.at(0).polygons;
    CHECK(polygons.size() == 12);
    CHECK(std::ranges::all_of(polygons, [](const Polygon& p) { return p.rings[0].size() == 3; }));
  }

  TEST_CASE("OBJ groups are the labels and survive reading") {
    const Document document = house_of(BoxFile().text());
    const Document again = house_of(write_obj(mesh_of(document, {box_labels()})), "a.obj");
    std::vector<std::string> hints;
    for (const Polygon& polygon : again.buildings.at(0).polygons) hints.push_back(polygon.hint);
    CHECK(hints == std::vector<std::string>{"house/unlabelled", "house/wall", "house/wall",
                                            "house/window_w_1", "house/window_w_1",
                                            "house/chimney_c1"});
    CHECK(again.buildings[0].is_solid);
  }

  TEST_CASE("PLY is written as a header and points and faces with their features") {
    const Document document = house_of(BoxFile().text());
    const std::string text = write_ply(mesh_of(document, {box_labels()}));
    CHECK(
        text.starts_with("ply\nformat ascii 1.0\ncomment oriel: metres, z up\n"
                         "comment feature 0 house unlabelled\ncomment feature 1 house wall\n"
                         "comment feature 2 house window_w_1\n"));
    CHECK(text.find("element vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
                    "element face 6\nproperty list uchar int vertex_indices\n"
                    "property int feature\nend_header\n") != std::string::npos);
    CHECK(text.find("\n1000.5 2000.25 10\n") != std::string::npos);
    const Document again = house_of(text, "a.ply");
    std::vector<std::string> hints;
    for (const Polygon& polygon : again.buildings.at(0).polygons) hints.push_back(polygon.hint);
    std::ranges::sort(hints);
    CHECK(hints == std::vector<std::string>{"house chimney_c1", "house unlabelled", "house wall",
                                            "house wall", "house window_w_1", "house window_w_1"});
    CHECK(again.buildings[0].is_solid);
    CHECK(again.buildings[0].polygons.size() == 6);
  }

  TEST_CASE("a face with more than 255 corners has a longer count in PLY") {
    MeshSource disc;
    disc.features = {{"disc", "roof", ""}};
    disc.polygons = {{{{}}, {0, 0, 1}, 0}};
    for (int i = 0; i < 300; ++i) {
      disc.points.push_back({std::cos(i * 0.02), std::sin(i * 0.02), 0});
      disc.polygons[0].rings[0].push_back(i);
    }
    const std::string text = write_ply(disc);
    CHECK(text.find("property list uint int vertex_indices\n") != std::string::npos);
    CHECK(house_of(text, "a.ply").buildings.at(0).polygons.at(0).rings[0].size() == 300);
  }

  TEST_CASE("bodies that touch along an edge are written with the vertices they came with") {
    // Two boxes with an edge in common, as OpenMesh would refuse them.
    Solid boxes;
    test::add_box(boxes, {0, 0, 0}, {1, 1, 1}, 0);
    test::add_box(boxes, {1, 1, 0}, {2, 2, 1}, 1);
    LabelledBuilding labelled;
    labelled.building = "house";
    labelled.geometry = boxes;
    const std::string text = write_obj(mesh_of(house_of(BoxFile().text()), {labelled}));
    CHECK(std::ranges::count(text, 'v') == 16);
    CHECK(text.find("f 1 4 3 2\n") != std::string::npos);
    CHECK(text.find("f 9 12 11 10\n") != std::string::npos);
    CHECK(house_of(text, "a.obj").buildings.at(0).polygons.size() == 12);
  }

  TEST_CASE("STL has one solid for each label") {
    const Document document = house_of(BoxFile().text());
    const std::string text = write_stl(mesh_of(document, {box_labels()}));
    for (const char* name : {"chimney", "unlabelled", "wall", "window"}) {
      CHECK(text.find("solid " + std::string(name) + "\n") != std::string::npos);
      CHECK(text.find("endsolid " + std::string(name) + "\n") != std::string::npos);
    }
    std::size_t facets = 0;
    for (std::size_t at = 0; (at = text.find("facet normal", at)) != std::string::npos; ++at)
      ++facets;
    CHECK(facets == 12);
  }

  TEST_CASE("STL has one solid for each class of surfaces where that is asked for") {
    const Document document = house_of(BoxFile().text());
    const std::string text = write_stl(mesh_of(document, {box_labels()}), StlSolids::by_class);
    std::set<std::string> classes{"Unclassified"};
    for (const SemanticSurface& surface : box_labels().surfaces) classes.insert(surface.type);
    CHECK(classes.size() > 2);
    std::size_t solids = 0;
    for (std::size_t at = 0; (at = text.find("\nsolid ", at)) != std::string::npos; ++at) ++solids;
    CHECK(solids + 1 == classes.size());
    for (const std::string& name : classes)
      CHECK(text.find("solid " + name + "\n") != std::string::npos);
  }

  TEST_CASE("a replaced geometry is what meshes show") {
    LabelledBuilding labelled;
    labelled.building = "house";
    labelled.geometry.emplace();
    test::add_box(*labelled.geometry, {0, 0, 0}, {1, 1, 1}, 0);
    labelled.surfaces = {{"RoofSurface", -1, {}}};
    labelled.surface_of_polygon = {-1, 0};
    const MeshSource mesh = mesh_of(house_of(BoxFile().text()), {labelled});
    CHECK(mesh.points.size() == 8);
    CHECK(mesh.points[0] == Vec3{1000, 2000, 10});
    CHECK(mesh.polygons.size() == 6);
    CHECK(mesh.features.size() == 2);
    CHECK(mesh.features[1].label == "roof");
  }

  TEST_CASE("an OBJ file becomes a CityJSON file that keeps its coordinates") {
    const std::string obj =
        "v 678114.4441 5403766.115 414.03\nv 678115.444 5403766.115 414.03\nv 678114.444 "
        "5403767.115 414.03\nv 678114.444 5403766.115 415.03\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const Document document = house_of(obj, "my \"house\".obj");
    LabelledBuilding labelled;
    labelled.building = "my \"house\"";
    labelled.surfaces = {{"RoofSurface", -1, {}}};
    labelled.surface_of_polygon = {-1, -1, 0, -1};
    labelled.attributes = {{"oriel_pack", std::string("p")}};
    const std::string text = write_cityjson(document, {labelled});
    const auto json = nlohmann::json::parse(text);
    CHECK(test::structural_faults(json).empty());
    const auto& geometry = json["CityObjects"]["my \"house\""]["geometry"][0];
    CHECK(geometry["type"] == "Solid");
    CHECK(geometry["lod"] == "3");
    CHECK(geometry["semantics"]["values"] == nlohmann::json::parse("[[null,null,0,null]]"));
    const auto before = input_points(document);
    const auto after = input_points(house_of(text));
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i)
      CHECK(length(before[i] - after[i]) == doctest::Approx(0).epsilon(1e-8));
    CHECK(write_cityjson(house_of(text), {labelled}) == text);
  }

  TEST_CASE("coordinates in whole millimetres are written in millimetres") {
    const Document document = house_of(
        "v 678114.444 5403766.115 414.03\nv 678115.444 5403766.115 414.03\nv 678114.444 "
        "5403767.115 414.03\nf 1 2 3\n",
        "a.obj");
    const auto json = nlohmann::json::parse(write_cityjson(document, {}));
    CHECK(json["transform"]["scale"][0] == 0.001);
    CHECK(json["transform"]["translate"] == nlohmann::json::parse("[678114.0,5403766.0,414.0]"));
    CHECK(json["vertices"][1] == nlohmann::json::parse("[1444,115,30]"));
    CHECK(json["CityObjects"]["a"]["geometry"][0]["type"] == "MultiSurface");
  }
}

}  // namespace
}  // namespace oriel
