#include "io/records/stage_json.h"

#include "tests/io/segmentations.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using nlohmann::json;

const json kTree = json::parse(R"({"kind":"union","planes":[0],"value":0.25,"quality":0.5,
    "rest":[{"kind":"leaf","cell":0}],
    "parts":[{"kind":"difference","planes":[1],"value":0.75,"quality":null,
              "rest":[{"kind":"leaf","cell":1}],"parts":[{"kind":"leaf","cell":2}]}]})");

/// A node of the flat list with its children in it.
json nested(const json& root, const json& id) {
  json node = root["nodes"][id.get<std::size_t>()];
  CHECK(node["id"] == id);
  node.erase("id");
  for (const char* key : {"rest", "parts"})
    if (node.contains(key))
      for (json& child : node[key]) child = nested(root, json(child));
  return node;
}

/// How many brackets of an ASCII text are open at most.
int depth_of(const std::string& text) {
  int open = 0, most = 0;
  for (const char c : text) {
    open += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    most = std::max(most, open);
  }
  return most;
}

TEST_SUITE("io") {
  TEST_CASE("a segmentation is one line of JSON with everything that machines read") {
    const test::SmallSegmentation small;
    const std::string line = segmentation_json(small.building, small.segmentation, small.table);
    CHECK(line.ends_with("}\n"));
    CHECK(std::ranges::count(line, '\n') == 1);
    const json root = json::parse(line);
    CHECK(root["id"] == "house");
    CHECK(root["frame"] ==
          json::parse(R"({"origin_m":[678114.0,5403766.0,414.0],"crs":"EPSG:25832"})"));
    CHECK(root["planes"][1] == json::parse(R"({"id":1,"normal":[0.0,-1.0,0.0],"offset_m":-0.5})"));
    CHECK(root["order"] == "natural");
    CHECK(root["cells"][2] ==
          json::parse(R"({"id":2,"sign":-1,"volume_m3":0.125,"convex":true,"flag":"own"})"));
    CHECK(nested(root, root["root"]) == kTree);
    CHECK(root["stats"] ==
          json::parse(R"({"leaves":3,"inner":2,"recursions":5,"protrusion_tests":10,
        "hole_tests":20,"candidates":4,"instanced":0})"));
    CHECK(root["issues"] == json::parse(R"([{"severity":"warning","code":"E901",
        "sentence":"a \"budget\"","feature":"w1"}])"));
  }

  TEST_CASE("features carry their ids and boxes in the input's coordinates") {
    const test::SmallSegmentation small;
    const json root =
        json::parse(segmentation_json(small.building, small.segmentation, small.table));
    CHECK(root["features"][0]["parent"].is_null());
    CHECK(root["features"][0]["quality"].is_null());
    CHECK(root["features"][1] ==
          json::parse(
              R"({"id":"w1","name":"part 1 of the inside","parent":"b1","host":"b1","sense":"hole",
        "value":null,"quality":null,"new_area_m2":0,"old_area_m2":0,"planes":[1],"split_order":1,
        "volume_m3":0.1,"aabb_m":[678114.25,5403766.5,415.0,678114.75,5403766.625,416.0],
        "source_polygons":[5],"flags":["natural","own"]})"));
  }

  TEST_CASE("a cell complex adds its faces, the vertices in use and each contact once") {
    const test::SmallSegmentation small;
    const std::vector<Vertex> vertices{
        {{9, 9, 9}}, {{0, 0, 0}}, {{1, 0, 0}}, {{1, 0, 2}}, {{0, 0, 2}}};
    const Loop loop{1, 2, 3, 4};
    const CellComplex complex(vertices,
                              {{PlaneId{0}, {loop}, CellId{}, CellId{1}, 2},
                               {PlaneId{1}, {loop}, CellId{2}, CellId{1}, 2}},
                              3);
    const json root =
        json::parse(segmentation_json(small.building, small.segmentation, small.table, &complex));
    CHECK(root["vertices"] == json::parse("[[0,0,0],[1,0,0],[1,0,2],[0,0,2]]"));
    CHECK(root["faces"] == json::parse(R"([
        {"id":0,"plane":0,"front":null,"behind":1,"area_m2":2,"loops":[[0,1,2,3]]},
        {"id":1,"plane":1,"front":2,"behind":1,"area_m2":2,"loops":[[0,1,2,3]]}])"));
    CHECK(root["contacts"] == json::parse(R"([
        {"cell":1,"neighbour":null,"area_m2":2},{"cell":1,"neighbour":2,"area_m2":2}])"));
    // Two faces of four edges do not close around anything.
    CHECK(root["open_edges"] == 3 * 4);
    CHECK_FALSE(json::parse(segmentation_json(small.building, small.segmentation, small.table))
                    .contains("faces"));
  }

  TEST_CASE("the form of a tree before this release is nested") {
    const test::SmallSegmentation small;
    const json root = json::parse(segmentation_json(small.building, small.segmentation, small.table,
                                                    nullptr, TreeForm::nested));
    CHECK(root["tree"] == kTree);
    CHECK_FALSE(root.contains("nodes"));
  }

  TEST_CASE("a tree of any depth is written and nests no deeper") {
    test::SmallSegmentation small;
    Segmentation& segmentation = small.segmentation;
    constexpr int kDepth = 200000;
    segmentation.nodes.assign(2 * kDepth + 1, {});
    for (int i = 0; i < kDepth; ++i) {
      CsgNode& node = segmentation.nodes[static_cast<std::size_t>(2 * i)];
      node.kind = CsgNode::Kind::subtract;
      node.rest = {NodeId{2 * i + 2}};
      node.parts = {NodeId{2 * i + 1}};
    }
    segmentation.features.clear();
    const FeatureTable table("house", 0);
    const std::string line = segmentation_json(small.building, segmentation, table);
    CHECK(depth_of(line) <= 4);
    CHECK(json::parse(line)["nodes"].size() == segmentation.nodes.size());
    const std::string deep =
        segmentation_json(small.building, segmentation, table, nullptr, TreeForm::nested);
    CHECK(depth_of(deep) > kDepth);
    CHECK(std::ranges::count(deep, '{') == std::ranges::count(deep, '}'));
  }

  TEST_CASE("a segmentation of nothing is still an object") {
    const json root = json::parse(segmentation_json({}, {}, {}));
    CHECK(root["root"].is_null());
    CHECK(root["nodes"].empty());
    CHECK(root["features"].empty());
    CHECK(json::parse(segmentation_json({}, {}, {}, nullptr, TreeForm::nested))["tree"].is_null());
  }
}

}  // namespace
}  // namespace oriel
