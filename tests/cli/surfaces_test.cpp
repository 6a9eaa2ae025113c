#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

std::vector<std::string> labelled_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(".labelled.city.json")) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// What `score --surfaces --json` says of files.
json surface_score(const std::vector<std::string>& files,
                   const std::vector<std::string>& options = {}) {
  std::vector<std::string> arguments{"score", "--surfaces", "--json"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  arguments.insert(arguments.end(), files.begin(), files.end());
  const Outcome outcome = run(arguments);
  // Most of these models are open, so that their features are not found.
  CHECK((outcome.exit == 0 || outcome.exit == 3));
  return json::parse(outcome.out);
}

void check_at_least(const json& score, double bound) {
  for (const char* type : {"WallSurface", "RoofSurface", "GroundSurface"}) {
    CAPTURE(type);
    CHECK(score["surfaces"][type]["recall"].get<double>() >= bound);
    CHECK(score["surfaces"][type]["precision"].get<double>() >= bound);
  }
}

std::string surface_of(const json& city, const std::string& id, std::size_t polygon) {
  const json& semantics = city["CityObjects"][id]["geometry"][0]["semantics"];
  const json& number = semantics["values"][0][polygon];
  return number.is_null() ? "" : semantics["surfaces"][number.get<std::size_t>()]["type"];
}

/// A cube whose underside is called a roof and whose top is a wall; the others have no name.
json half_named() {
  json city = cubes({"c"});
  city["CityObjects"]["c"]["geometry"][0]["semantics"] = {
      {"surfaces", {{{"type", "RoofSurface"}}, {{"type", "WallSurface"}, {"colour", "red"}}}},
      {"values", {{0, 1, nullptr, nullptr, nullptr, nullptr}}}};
  return city;
}

json labelled(const Folder& folder, const std::string& mode) {
  const std::string out = folder / (mode + ".city.json");
  CHECK(run({"label", folder.write("in.city.json", half_named().dump()), "--existing", mode, "-o",
             out})
            .exit == 0);
  return json::parse(bytes_of(out));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("walls and roofs and grounds of random3dcity are named as its own semantics say") {
    ORIEL_NEEDS_SHARED(shared);
    const auto files = labelled_files(shared / "data/random3dcity");
    REQUIRE(files.size() == 76);
    const json score = surface_score(files);
    check_at_least(score, 0.98);
    CHECK(score["surfaces"]["OuterFloorSurface"]["recall"].get<double>() >= 0.9);
  }

  TEST_CASE("walls and roofs and grounds of 3dbag are named as its own semantics say") {
    ORIEL_NEEDS_SHARED(shared);
    const std::string tile = shared / "data/3dbag/tile_5910.city.jsonl";
    for (const char* lod : {"1.2", "1.3", "2.2"})
      check_at_least(
          surface_score({tile}, {"--lod", lod, "--rules", "surfaces-only", "--budget", "2000000"}),
          0.99);
  }

  TEST_CASE("outer ceilings and floors of open buildings are found in ingolstadt") {
    ORIEL_NEEDS_SHARED(shared);
    const auto files = labelled_files(shared / "data/ingolstadt");
    REQUIRE(files.size() == 19);
    const json score = surface_score(files, {"--rules", "surfaces-only"});
    check_at_least(score, 0.98);
    for (const char* type : {"OuterCeilingSurface", "OuterFloorSurface"}) {
      CHECK(score["surfaces"][type]["recall"].get<double>() >= 0.75);
      CHECK(score["surfaces"][type]["precision"].get<double>() >= 0.9);
    }
  }

  TEST_CASE("a building that stays open still has its surfaces named") {
    const Folder folder;
    json city = cubes({"c"});
    json& shell = city["CityObjects"]["c"]["geometry"][0]["boundaries"][0];
    shell.erase(5);
    const std::string out = folder / "out.city.json";
    const Outcome outcome =
        run({"label", folder.write("open.city.json", city.dump()), "-o", out, "--close", "planar"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("1 open"));
    const json found = json::parse(bytes_of(out));
    CHECK(surface_of(found, "c", 0) == "GroundSurface");
    CHECK(surface_of(found, "c", 1) == "RoofSurface");
    for (std::size_t wall = 2; wall < 5; ++wall)
      CHECK(surface_of(found, "c", wall) == "WallSurface");
  }

  TEST_CASE("existing semantics are filled or kept or replaced") {
    const Folder folder;
    for (const char* mode : {"fill", "keep"}) {
      const json city = labelled(folder, mode);
      CHECK(surface_of(city, "c", 0) == "RoofSurface");
      CHECK(surface_of(city, "c", 1) == "WallSurface");
      CHECK(surface_of(city, "c", 2) == "WallSurface");
      const json& surfaces = city["CityObjects"]["c"]["geometry"][0]["semantics"]["surfaces"];
      CHECK(surfaces[1] == json{{"type", "WallSurface"}, {"colour", "red"}});
    }
    const json city = labelled(folder, "replace");
    CHECK(surface_of(city, "c", 0) == "GroundSurface");
    CHECK(surface_of(city, "c", 1) == "RoofSurface");
    CHECK(city.dump().find("colour") == std::string::npos);
  }

  TEST_CASE("an audit lists what is called otherwise with place and area and writes nothing") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", half_named().dump());
    const Outcome outcome = run({"label", input, "--existing", "audit", "--json"});
    CHECK(outcome.exit == 3);
    const json found = json::parse(outcome.out);
    REQUIRE(found["differences"].size() == 2);
    const json& first = found["differences"][0];
    CHECK(first["building"] == "c");
    CHECK(first["polygon"] == 0);
    CHECK(first["theirs"] == "RoofSurface");
    CHECK(first["ours"] == "GroundSurface");
    CHECK(first["area_m2"].get<double>() == doctest::Approx(16));
    CHECK(first["place"][2].get<double>() == doctest::Approx(0));
    CHECK(found["unnamed_m2"].get<double>() == doctest::Approx(64));
    const Outcome text = run({"label", input, "--existing", "audit"});
    CHECK(text.out.find("c: polygon 0 is RoofSurface, by the rules GroundSurface: 16.00 m2 at "
                        "(2.000, 2.000, 0.000)") != std::string::npos);
    CHECK(folder.names() == std::vector<std::string>{"in.city.json"});
    CHECK(run({"label", input, "--existing", "audit", "-o", folder / "x.city.json"}).exit == 2);
    CHECK(run({"label", input, "--json"}).exit == 2);
  }

  TEST_CASE("an audit of what the rules themselves named finds nothing") {
    const Folder folder;
    const std::string out = folder / "out.city.json";
    for (const char* name : {"house", "block", "row"}) {
      CHECK(run({"label", sample(name), "-o", out}).exit == 0);
      const Outcome outcome = run({"label", out, "--existing", "audit", "--json"});
      CHECK(outcome.exit == 0);
      CHECK(json::parse(outcome.out)["agreement"].get<double>() == 1);
    }
  }

  TEST_CASE("a surface is explained by its number") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", half_named().dump());
    const Outcome outcome = run({"explain", input, "--surface", "1"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with("c: polygon 1 is RoofSurface by roof.any\n"));
    CHECK(outcome.out.find("holds    inclination < $steepest_roof") != std::string::npos);
    CHECK(run({"explain", input, "--surface", "6"}).exit == 2);
  }
}
