#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <array>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::test;
using nlohmann::ordered_json;

TEST_SUITE("cli") {
  TEST_CASE("an installation with its own geometry is cut and named with its building") {
    for (const bool is_closed : {false, true}) {
      CAPTURE(is_closed);
      const ordered_json before = cube_with_shaft(4000, is_closed);
      const Outcome outcome =
          run({"label", "-", "--from", "cityjson", "-o", "-"}, {.in = before.dump()});
      CHECK(outcome.exit == 0);
      CHECK(outcome.says("1 chimney"));
      const ordered_json after = ordered_json::parse(outcome.out);
      const ordered_json& objects = after["CityObjects"];
      // Its own object keeps its polygons, and they say what they are.
      const ordered_json& shaft = objects["shaft"]["geometry"][0];
      CHECK(shaft["boundaries"] == before["CityObjects"]["shaft"]["geometry"][0]["boundaries"]);
      CHECK(shaft["semantics"]["values"].size() == shaft["boundaries"].size());
      CHECK(objects["house"]["geometry"][0]["boundaries"] ==
            before["CityObjects"]["house"]["geometry"][0]["boundaries"]);
      CHECK(objects["house"]["children"].size() == 2);
      const Outcome again =
          run({"label", "-", "--from", "cityjson", "-o", "-"}, {.in = outcome.out});
      CHECK(again.out == outcome.out);
    }
  }

  TEST_CASE("an installation that stands in its building is a part of it from where it leaves it") {
    const Outcome outcome = run({"label", "-", "--from", "cityjson", "-o", "-"},
                                {.in = cube_with_shaft(3700, true).dump()});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("1 chimney"));
  }

  TEST_CASE("an installation that bounds nothing leaves its building as it is") {
    const ordered_json city = cube_with_shaft(5000);
    const Outcome outcome =
        run({"label", "-", "--from", "cityjson", "-o", "-"}, {.in = city.dump()});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("E315 5 polygons do not bound the solid"));
    const ordered_json objects = ordered_json::parse(outcome.out)["CityObjects"];
    CHECK(objects["shaft"]["geometry"][0]["boundaries"] ==
          city["CityObjects"]["shaft"]["geometry"][0]["boundaries"]);
  }

  TEST_CASE("an installation that keeps its building from closing is left out of the solid") {
    // Four sides of a large box around one half of the cube, one corner moved.
    ordered_json city = cube_with_shaft();
    ordered_json& vertices = city["vertices"];
    for (int i = 0; i < 8; ++i)
      vertices[static_cast<std::size_t>(8 + i)] = {-1000 + (i & 1) * 3000, (i >> 1 & 1) * 6000,
                                                   (i >> 2) * 6000};
    vertices[8] = {-1700, 300, 300};
    city["CityObjects"]["shaft"]["geometry"][0]["boundaries"] =
        ordered_json::parse("[[[10,8,12,14]],[[9,11,15,13]],[[12,13,15,14]],[[8,9,13,12]]]");
    const Outcome outcome =
        run({"label", "-", "--from", "cityjson", "-o", "-", "-v"}, {.in = city.dump()});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says(
        "E320 does not form a closed solid together with the installation that stands on it"));
    CHECK(outcome.says("1 of 1 building labelled"));
    CHECK_FALSE(outcome.says("open"));
  }

  TEST_CASE("installations that share the polygons of a solid leave with it when it is redrawn") {
    const Folder folder;
    for (const char* name : {"house", "row", "l-house"}) {
      CAPTURE(name);
      const std::string file = replaced(sample(name), "stripped", "labelled");
      const std::string level = folder / "level.city.json", to = folder / name;
      REQUIRE(run({"generalise", file, "--scale", "1:2500", "-o", level}).exit == 0);
      const auto before = ordered_json::parse(bytes_of(file))["CityObjects"];
      const auto after = ordered_json::parse(bytes_of(level))["CityObjects"];
      CHECK(before.size() > after.size());
      for (const auto& [id, object] : after.items())
        CHECK((object["type"] == "Building" || object["attributes"].contains("oriel_id")));
      REQUIRE(run({"generalise", file, "--series", "1:1000,1:2500", "-o", to}).exit == 0);
      CHECK(run({"generalise", "--check", "--from", to}).exit == 0);
      // Repaired, they are what they were.
      REQUIRE(run({"repair", file, "-o", level}).exit == 0);
      CHECK(ordered_json::parse(bytes_of(level))["CityObjects"].size() == before.size());
    }
  }

  TEST_CASE("the geometry of an installation is judged by validate and no concern of repair") {
    const ordered_json city = cube_with_shaft(5000);
    const Outcome judged = run({"validate", "-", "--from", "cityjson"}, {.in = city.dump()});
    CHECK(judged.exit == 0);
    CHECK(judged.out == "house: valid\nshaft: valid as loose surfaces\n");
    const Outcome repaired =
        run({"repair", "-", "--from", "cityjson", "-o", "-"}, {.in = city.dump()});
    CHECK(repaired.exit == 0);
    CHECK(ordered_json::parse(repaired.out)["CityObjects"]["shaft"] ==
          city["CityObjects"]["shaft"]);
  }

  TEST_CASE(
      "an installation that stays as it is and is not valid is named and the end is not clean") {
    ordered_json city = cube_with_shaft();
    auto& surfaces = city["CityObjects"]["shaft"]["geometry"][0]["boundaries"];
    CHECK(run({"generalise", "-", "--from", "cityjson", "--scale", "1:500", "-o", "-"},
              {.in = city.dump()})
              .exit == 0);
    // A kink of 6 mm over 10 mm: within the planarity of 10 mm, its triangle is tilted by 31°.
    const int first = static_cast<int>(city["vertices"].size());
    for (const auto& [x, y, z] : std::vector<std::array<int, 3>>{
             {0, 0, 6000}, {2000, 0, 6000}, {2000, 2000, 6000}, {0, 2000, 6000}, {0, 1990, 6006}})
      city["vertices"].push_back({x, y, z});
    surfaces.push_back({{first, first + 1, first + 2, first + 3, first + 4}});
    const Outcome judged =
        run({"validate", "-", "--from", "cityjson", "--json"}, {.in = city.dump()});
    CHECK(judged.exit == 3);
    CHECK(judged.out.find("\"val3dity\":204") != std::string::npos);
    for (const auto& target : std::vector<std::vector<std::string>>{
             {"--scale", "1:500"}, {"--scale", "1:25000"}, {"--to-lod", "2.0"}}) {
      CAPTURE(target[1]);
      const Outcome drawn =
          run({"generalise", "-", "--from", "cityjson", target[0], target[1], "-o", "-"},
              {.in = city.dump()});
      CHECK(drawn.exit == 3);
      CHECK(drawn.says("E321 its installation 'shaft' stays unchanged and is not valid: E345"));
      CHECK(drawn.out.find("\"house\"") != std::string::npos);
    }
    const Folder folder;
    const Outcome series = run({"generalise", "-", "--from", "cityjson", "--series",
                                "1:500,1:25000", "-o", folder / "house"},
                               {.in = city.dump()});
    CHECK(series.exit == 3);
    CHECK(series.says("E321 its installation 'shaft' stays unchanged and is not valid: E345"));
    CHECK(bytes_of(folder / "house.1-500.city.json").find("\"house\"") != std::string::npos);
    CHECK(run({"validate", folder / "house.1-25000.city.json"}).exit == 3);
  }
}
