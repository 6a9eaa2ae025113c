#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/cli/json_lines.h"

#include <array>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::ordered_json;

namespace {

/// A cube of 4 m with semantics, without its polygon of that number: 0 is its ground, 1 its roof.
ordered_json cube_lacking(std::size_t polygon) {
  ordered_json city = cubes({"c"});
  ordered_json& geometry = city["CityObjects"]["c"]["geometry"][0];
  ordered_json values = {1, 0, 2, 2, 2, 2};
  values.erase(polygon);
  geometry["boundaries"][0].erase(polygon);
  geometry["semantics"] = {
      {"surfaces",
       {{{"type", "RoofSurface"}}, {{"type", "GroundSurface"}}, {{"type", "WallSurface"}}}},
      {"values", ordered_json::array({values})}};
  return city;
}

/// The types of the surfaces of all polygons of the object's solid, with their numbers.
std::map<std::string, int> types_of(const std::string& file, const std::string& id) {
  std::map<std::string, int> count;
  const auto city = nlohmann::json::parse(bytes_of(file));
  const auto& geometry = city["CityObjects"][id]["geometry"][0];
  REQUIRE(geometry.contains("semantics"));
  const auto& semantics = geometry["semantics"];
  for (const auto& shell : semantics["values"])
    for (const auto& value : shell)
      ++count[semantics["surfaces"][value.get<std::size_t>()]["type"].get<std::string>()];
  return count;
}

/// Six rectangles that run 0.5 m through each other where they should meet in the edges of a box of
/// 10 m × 8 m × 6 m.
ordered_json crossed_box() {
  ordered_json city = cubes({});
  ordered_json polygons = ordered_json::array();
  const std::array<int, 3> sides{10000, 8000, 6000};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int level : {0, sides[axis]}) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      ordered_json ring = ordered_json::array();
      for (const auto& [a, b] : {std::pair(false, false), std::pair(true, false),
                                 std::pair(true, true), std::pair(false, true)}) {
        std::array<int, 3> corner{};
        corner[axis] = level;
        corner[u] = a ? sides[u] + 500 : -500;
        corner[v] = b ? sides[v] + 500 : -500;
        ring.push_back(city["vertices"].size());
        city["vertices"].push_back(corner);
      }
      polygons.push_back(ordered_json::array({ring}));
    }
  city["CityObjects"]["x"] = {
      {"type", "Building"},
      {"geometry",
       ordered_json::array({{{"type", "MultiSurface"}, {"lod", "2"}, {"boundaries", polygons}}})}};
  return city;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("repair closes a missing ground or wall with a ClosureSurface and says so") {
    const Folder folder;
    const std::string out = folder / "out.city.json";
    for (const std::size_t gone : {0, 2, 3, 4, 5}) {
      CAPTURE(gone);
      const std::string input = folder.write("in.city.json", cube_lacking(gone).dump());
      const Outcome made = run({"repair", input, "-o", out, "--report", folder / "r"});
      CHECK(made.exit == 0);
      const std::string kind = gone == 0 ? "ground" : "wall";
      CHECK(made.says("warning: c: E316 1 hole was closed by a face of oriel's own, 16.00 m²: 1 " +
                      kind + " (16.00 m²)"));
      CHECK(json_lines(bytes_of(folder / "r")).at(0)["caps"][0]["kind"] == kind);
      const auto types = types_of(out, "c");
      CHECK(types.at("ClosureSurface") == 1);
      CHECK(types.at("RoofSurface") == 1);
      CHECK(types.at("WallSurface") == (gone == 0 ? 4 : 3));
      CHECK(run({"validate", out}).exit == 0);
      CHECK(run({"repair", input, "-o", out, "--close", "planar"}).exit == 3);
    }
  }

  TEST_CASE("repair leaves a building open that lacks its roof unless all may be closed") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", cube_lacking(1).dump());
    const std::string out = folder / "out.city.json";
    CHECK(run({"repair", input, "-o", out}).exit == 3);
    CHECK(run({"repair", input, "-o", out, "--close", "any"}).exit == 0);
  }

  TEST_CASE("a closing face in the plane of a wall is written by itself") {
    // A second cube on the first one, without the wall of the lower one at x = 0.
    ordered_json city = cube_lacking(5);
    ordered_json& geometry = city["CityObjects"]["c"]["geometry"][0];
    for (int i = 4; i < 8; ++i)
      city["vertices"].push_back({(i & 1) * 4000, (i >> 1 & 1) * 4000, 8000});
    ordered_json& shell = geometry["boundaries"][0];
    shell[1] = {{8, 9, 11, 10}};
    for (const std::vector<int>& ring : std::vector<std::vector<int>>{
             {4, 5, 9, 8}, {5, 7, 11, 9}, {7, 6, 10, 11}, {6, 4, 8, 10}}) {
      shell.push_back({ring});
      geometry["semantics"]["values"][0].push_back(2);
    }
    const Folder folder;
    const std::string input = folder.write("in.city.json", city.dump());
    const std::string out = folder / "out.city.json";
    CHECK(run({"repair", input, "-o", out}).exit == 0);
    CHECK(types_of(out, "c") ==
          std::map<std::string, int>{
              {"ClosureSurface", 1}, {"GroundSurface", 1}, {"RoofSurface", 1}, {"WallSurface", 4}});
    CHECK(run({"validate", out}).exit == 0);
  }

  TEST_CASE("label writes no closing face and generalise writes it as a ClosureSurface") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", cube_lacking(0).dump());
    const std::string out = folder / "out.city.json";
    const Outcome labelled = run({"label", input, "-o", out});
    CHECK(labelled.exit == 0);
    CHECK_FALSE(labelled.says("open"));
    CHECK(labelled.says("E316"));
    CHECK(types_of(out, "c") == std::map<std::string, int>{{"RoofSurface", 1}, {"WallSurface", 4}});
    const Outcome drawn = run({"generalise", input, "--scale", "1:2500", "-o", out});
    CHECK(drawn.exit == 0);
    CHECK(types_of(out, "c") == std::map<std::string, int>{
                                    {"ClosureSurface", 1}, {"RoofSurface", 1}, {"WallSurface", 4}});
    CHECK(run({"label", input, "-o", out, "--repaired"}).exit == 0);
    CHECK(types_of(out, "c").at("ClosureSurface") == 1);
  }

  TEST_CASE("windows that stand open in an OBJ and are closed are reported with their number") {
    const Folder folder;
    REQUIRE(run({"label", sample("house"), "-o", folder / "whole.obj"}).exit == 0);
    std::string open, group;
    for (const std::string& line : lines_of(bytes_of(folder / "whole.obj"))) {
      if (line.starts_with("g ")) group = line;
      if (!line.starts_with("f ") || !group.starts_with("g window")) open += line + "\n";
    }
    const std::string in = folder.write("open.obj", open);
    const std::string said =
        "; they may be open windows or doors, which cannot be found once closed (--close none "
        "keeps holes open)\n";
    const Outcome labelled = run({"label", in});
    CAPTURE(labelled.err);
    CHECK(labelled.exit == 0);
    CHECK(labelled.says("warning: open: E316 16 holes were closed by faces of oriel's own, "));
    CHECK(labelled.says(said));
    CHECK_FALSE(labelled.says("window,"));
    CHECK(run({"segment", in}).says(said));
    CHECK(
        run({"generalise", in, "--scale", "1:1000", "-o", folder / "small.city.json"}).says(said));
    const Outcome kept = run({"label", in, "--close", "none"});
    CHECK_FALSE(kept.says("E316"));
    CHECK(kept.says("17 window,"));
  }

  TEST_CASE("a ground that was missing is not taken for an open window") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cube_lacking(0).dump());
    const Outcome labelled = run({"label", in});
    CHECK(labelled.says("E316 1 hole was closed"));
    CHECK_FALSE(labelled.says("open window"));
  }

  TEST_CASE("an open building that repair mends is mended before it is generalised") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", crossed_box().dump());
    const std::string out = folder / "out.city.json";
    CHECK(run({"label", input}).says("1 open"));
    REQUIRE(run({"repair", input, "-o", out}).exit == 0);
    const Outcome drawn = run(
        {"generalise", input, "--scale", "1:2500", "-o", out, "--features", folder / "f.jsonl"});
    CHECK(drawn.exit == 0);
    CHECK(drawn.says(
        "warning: x: G420 is open in the input and is repaired first, with 6 polygons cut"));
    CHECK(drawn.says("1 of 1 building generalised to 1:2500"));
    CHECK(run({"validate", out}).exit == 0);
    const auto types = types_of(out, "x");
    CHECK(types.at("RoofSurface") == 1);
    CHECK(types.at("WallSurface") == 4);
    const Outcome series =
        run({"generalise", input, "--series", "1:1000,1:5000", "-o", folder / "s"});
    CHECK(series.exit == 0);
    CHECK(series.says("G420"));
    CHECK(run({"validate", folder / "s.1-5000.city.json"}).exit == 0);
    // What may not be closed is not repaired either.
    const std::string roofless = folder.write("roofless.city.json", cube_lacking(1).dump());
    CHECK(run({"generalise", roofless, "--scale", "1:2500", "-o", out})
              .says("c: G404 is open and cannot be repaired"));
  }
}
