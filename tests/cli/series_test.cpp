#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

TEST_SUITE("cli") {
  TEST_CASE("a series is a file for each scale and a log") {
    const Folder folder;
    const Outcome made = run({"generalise", sample("house"), "--series", "1:500,1:10000,1:2500",
                              "-o", folder / "house"});
    REQUIRE(made.exit == 0);
    std::size_t objects = 100;
    for (const char* scale : {"500", "2500", "10000"}) {
      const json city =
          json::parse(bytes_of(folder / (std::string("house.1-") + scale + ".city.json")));
      CHECK(city["CityObjects"].size() <= objects);
      objects = city["CityObjects"].size();
    }
    CHECK(objects == 1);
    std::istringstream lines(bytes_of(folder / "house.oplog.jsonl"));
    double scale = 0;
    int operations = 0;
    for (std::string line; std::getline(lines, line); ++operations) {
      const json operation = json::parse(line);
      for (const char* key : {"building", "oriel_id", "label", "operation", "rule", "scale", "aabb",
                              "forward", "inverse"})
        CHECK(operation.contains(key));
      CHECK(operation["scale"] >= scale);
      scale = operation["scale"];
    }
    CHECK(operations > 30);
    const Outcome at = run({"generalise", "--at", "1:10000", "--from", folder / "house", "-o",
                            folder / "at.city.json"});
    REQUIRE(at.exit == 0);
    CHECK(bytes_of(folder / "at.city.json") == bytes_of(folder / "house.1-10000.city.json"));
  }

  TEST_CASE("a level between is the same from the finer and from the coarser file") {
    const Folder folder;
    REQUIRE(
        run({"generalise", sample("house"), "--series", "1:500,1:10000", "-o", folder / "house"})
            .exit == 0);
    const auto boundaries = [&] {
      const Outcome at =
          run({"generalise", "--at", "1:2500", "--from", folder / "house", "-o", "-"});
      REQUIRE(at.exit == 0);
      const json city = json::parse(at.out);
      std::multiset<std::string> polygons;
      for (const json& polygon : city["CityObjects"]["house"]["geometry"][0]["boundaries"][0]) {
        json points;
        for (const json& ring : polygon)
          for (const json& v : ring) points.push_back(city["vertices"][v.get<std::size_t>()]);
        polygons.insert(points.dump());
      }
      return polygons;
    };
    const auto both = boundaries();
    CHECK(both.size() > 20);
    std::remove((folder / "house.1-500.city.json").c_str());
    CHECK(boundaries() == both);
  }

  TEST_CASE("a series that is not there or does not fit is refused") {
    const Folder folder;
    CHECK(run({"generalise", "--at", "1:10", "--from", folder / "none", "-o", "-"}).says("E101"));
    CHECK(run({"generalise", "--at", "1:10", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", "--series", "1:500", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--series", "1:500,1:500", "-o", "x"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--series", "1:0", "-o", "x"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--from", "word", "--scale", "1:500", "-o", "-"})
              .exit == 2);
    REQUIRE(run({"generalise", sample("house"), "--series", "1:10000", "-o", folder / "a"}).exit ==
            0);
    REQUIRE(run({"generalise", sample("house"), "--series", "1:500", "-o", folder / "b"}).exit ==
            0);
    std::rename((folder / "b.1-500.city.json").c_str(), (folder / "a.1-10000.city.json").c_str());
    const Outcome wrong = run(
        {"generalise", "--at", "1:500", "--from", folder / "a", "-o", folder / "out.city.json"});
    CHECK(wrong.exit == 5);
    CHECK(wrong.says("G409"));
  }
}
