#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

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

  TEST_CASE("the geometry of an installation is no concern of repair and validate") {
    const ordered_json city = cube_with_shaft(5000);
    const Outcome judged = run({"validate", "-", "--from", "cityjson", "-v"}, {.in = city.dump()});
    CHECK(judged.exit == 0);
    CHECK(judged.says("E214 1 object of type BuildingInstallation with geometry is not checked"));
    const Outcome repaired =
        run({"repair", "-", "--from", "cityjson", "-o", "-"}, {.in = city.dump()});
    CHECK(repaired.exit == 0);
    CHECK(ordered_json::parse(repaired.out)["CityObjects"]["shaft"] ==
          city["CityObjects"]["shaft"]);
  }
}
