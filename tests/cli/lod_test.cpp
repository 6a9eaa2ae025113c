#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::multiset<std::string> lods_of(const json& city, const std::string& id) {
  std::multiset<std::string> lods;
  for (const json& geometry : city["CityObjects"][id]["geometry"])
    lods.insert(geometry["lod"].get<std::string>());
  return lods;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("levels of detail share a file and never stand twice in an object") {
    const Outcome first = run({"generalise", sample("house"), "--to-lod", "2.0,1.2", "-o", "-"});
    REQUIRE(first.exit == 0);
    CHECK(first.says("generalised to LoD 2.0, 1.2"));
    const json city = json::parse(first.out);
    CHECK(lods_of(city, "house") == std::multiset<std::string>{"1.2", "2.0"});
    CHECK(city["CityObjects"]["house"]["attributes"]["oriel_removed_dormer"] == 2);
    CHECK(city["CityObjects"].size() == 1);
    const Outcome second = run(
        {"generalise", "-", "--from", "cityjson", "--lod", "2.0", "--to-lod", "1.2,1.0", "-o", "-"},
        {.in = first.out});
    REQUIRE(second.exit == 0);
    CHECK(lods_of(json::parse(second.out), "house") == std::multiset<std::string>{"1.0", "1.2"});
  }

  TEST_CASE("either a scale or levels of detail are asked for") {
    CHECK(run({"generalise", sample("block"), "-o", "-"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--scale", "1:1000", "--to-lod", "2.0", "-o", "-"})
              .exit == 2);
    CHECK(run({"generalise", sample("block"), "--to-lod", "2.0,2.0", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--to-lod", "two", "-o", "-"}).exit == 2);
    const Outcome unknown = run({"generalise", sample("block"), "--to-lod", "3.3", "-o", "-"});
    CHECK(unknown.exit == 4);
    CHECK(unknown.says("R271"));
  }

  TEST_CASE("an account says what became of each feature and figures tell before from after") {
    const Folder folder;
    const Outcome made =
        run({"generalise", sample("house"), "--scale", "1:5000", "--explain", folder / "why.jsonl",
             "--metrics", folder / "figures.jsonl", "-o", folder / "out.city.json"});
    REQUIRE(made.exit == 0);
    int omitted = 0, kept = 0;
    std::istringstream lines(bytes_of(folder / "why.jsonl"));
    for (std::string line; std::getline(lines, line);) {
      const json deed = json::parse(line);
      CHECK(deed["target"] == "1:5000");
      if (deed["outcome"] == "omitted") CHECK_FALSE(deed["rule"].get<std::string>().empty());
      (deed["outcome"] == "omitted" ? omitted : kept) += 1;
    }
    CHECK(omitted > 20);
    CHECK(kept > 0);
    const json figures = json::parse(bytes_of(folder / "figures.jsonl"));
    CHECK(figures["facets_after"] < figures["facets_before"]);
    CHECK(figures["normals_after"] <= figures["normals_before"]);
    // The chimney that went is the furthest from what is left.
    CHECK(figures["hausdorff_m"] > 0.5);
    CHECK(figures["hausdorff_m"] < 3);
  }

  TEST_CASE("a map profile decides of what the pack has no entry for") {
    const Outcome without = run({"generalise", sample("house"), "--scale", "1:2500", "-o", "-"});
    const Outcome with =
        run({"generalise", sample("house"), "--scale", "1:2500", "--profile", "map", "-o", "-"});
    REQUIRE(without.exit == 0);
    REQUIRE(with.exit == 0);
    CHECK(with.out.size() <= without.out.size());
  }
}
