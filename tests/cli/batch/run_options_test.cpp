#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Names = std::vector<std::string>;

Names cube_names(int count) {
  Names names;
  for (int i = 0; i < count; ++i) names.push_back(fmt::format("cube-{}", i));
  return names;
}

/// The ids of the buildings that a stream on stdout holds; the exit code is 3 if none is labelled.
Names labelled(const std::string& text, Names options, int exit = 0) {
  options.insert(options.begin(), {"label", "-", "--from", "cityjsonseq", "-o", "-"});
  const Outcome outcome = run(options, {.in = text});
  CHECK(outcome.exit == exit);
  Names ids;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    const json record = json::parse(line);
    if (record["type"] == "CityJSONFeature") ids.push_back(record["id"]);
  }
  return ids;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("of a stream the selected buildings are worked on and written") {
    const std::string text = cube_lines({"a", "b", "c"});
    CHECK(labelled(text, {}) == Names{"a", "b", "c"});
    CHECK(labelled(text, {"--id", "b"}) == Names{"b"});
    CHECK(labelled(text, {"--id", "c", "--id", "a"}) == Names{"a", "c"});
    CHECK(labelled(text, {"--id", "b", "--exclude"}) == Names{"a", "c"});
    CHECK(labelled(text, {"--id", "none"}, 3).empty());
  }

  TEST_CASE("a box takes the buildings that have the middle of theirs in it") {
    // Every cube of a line by itself stands at the origin: 4 m wide.
    const std::string text = cube_lines({"a"});
    CHECK(labelled(text, {"--bbox", "1,1,3,3"}) == Names{"a"});
    CHECK(labelled(text, {"--bbox", "-9,-9,1,9"}, 3).empty());
    CHECK(labelled(text, {"--bbox", "-9,-9,1,9", "--exclude"}) == Names{"a"});
  }

  TEST_CASE("a random selection depends on seed and id alone") {
    Names names = cube_names(200);
    const Names taken = labelled(cube_lines(names), {"--random", "4", "--seed", "7"});
    CHECK(taken.size() > 20);
    CHECK(taken.size() < 90);
    std::ranges::reverse(names);
    Names again = labelled(cube_lines(names), {"--random", "4", "--seed", "7", "-j2"});
    std::ranges::reverse(again);
    CHECK(again == taken);
    CHECK(labelled(cube_lines(names), {"--random", "4", "--seed", "8"}) != again);
    const Names rest = labelled(cube_lines(names), {"--random", "4", "--seed", "7", "--exclude"});
    std::set<std::string> all(taken.begin(), taken.end());
    all.insert(rest.begin(), rest.end());
    CHECK(all.size() == names.size());
    CHECK(taken.size() + rest.size() == names.size());
  }

  TEST_CASE("a type takes the features whose object has it") {
    auto road = json::parse(cube_lines({"road"}).substr(cube_lines({}).size()));
    road["CityObjects"]["road"]["type"] = "Road";
    // The type is that of the feature, not of its parts.
    auto house = road;
    house["id"] = "house";
    house["CityObjects"] = {{"house", {{"type", "Building"}, {"children", {"part"}}}},
                            {"part", road["CityObjects"]["road"]}};
    house["CityObjects"]["part"]["type"] = "BuildingPart";
    house["CityObjects"]["part"]["parents"] = {"house"};
    const std::string text = cube_lines({"a", "b"}) + road.dump() + "\n" + house.dump() + "\n";
    CHECK(labelled(text, {"--cotype", "Building"}) == Names{"a", "b", "house"});
    CHECK(labelled(text, {"--cotype", "Road"}, 3) == Names{"road"});
    CHECK(labelled(text, {"--cotype", "Road", "--exclude"}) == Names{"a", "b", "house"});
    CHECK(labelled(text, {"--cotype", "Building", "--exclude"}, 3) == Names{"road"});
    CHECK(labelled(text, {"--cotype", "Building", "--id", "b"}) == Names{"b"});
    CHECK(labelled(text, {"--cotype", "BuildingPart"}, 3).empty());
    // The same of a file that is taken apart.
    const Folder folder;
    const std::string file = folder / "in.city.json";
    REQUIRE(run({"collect", "-", "-o", file}, {.in = text}).exit == 0);
    for (const std::string type : {"Road", "Building", "BuildingPart"})
      CHECK(run({"cat", file, "--cotype", type}).out ==
            run({"cat", "-", "--cotype", type}, {.in = run({"cat", file}).out}).out);
  }

  TEST_CASE("buildings of a file that are not selected stay as they came") {
    const auto city = cubes({"a", "b"});
    const Outcome outcome =
        run({"label", "-", "--from", "cityjson", "-o", "-", "--id", "b"}, {.in = city.dump()});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("1 of 1 building labelled"));
    const json out = json::parse(outcome.out);
    CHECK(out["CityObjects"]["a"] == city["CityObjects"]["a"]);
    CHECK(out["CityObjects"]["b"]["attributes"].contains("oriel_pack"));
  }

  TEST_CASE("faults of buildings that are not selected are neither told nor counted") {
    auto city = cubes({"a", "b"});
    city["CityObjects"]["a"]["geometry"][0]["boundaries"][0][0][0][0] = 999;
    const Outcome all = run({"segment", "-", "--from", "cityjson"}, {.in = city.dump()});
    CHECK(all.exit == 3);
    const Outcome one =
        run({"segment", "-", "--from", "cityjson", "--id", "b", "--json"}, {.in = city.dump()});
    CHECK(one.exit == 0);
    CHECK(one.says("1 of 1 building segmented"));
  }

  TEST_CASE("a box of three numbers or a share of no building is wrong usage") {
    CHECK(run({"label", sample("hip"), "--bbox", "1,2,3"}).exit == 2);
    CHECK(run({"label", sample("hip"), "--bbox", "1,2,3,x"}).exit == 2);
    CHECK(run({"label", sample("hip"), "--random", "0"}).exit == 2);
  }
}
