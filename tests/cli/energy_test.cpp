#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

TEST_SUITE("cli") {
  TEST_CASE("the table of energy has a row for each building on stdout") {
    const Outcome made = run({"label", sample("house"), "--table", "energy"});
    REQUIRE(made.exit == 0);
    const auto lines = lines_of(made.out);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].starts_with("building,lod,closed,not_separated,volume_m3,height_m,storeys,"));
    CHECK(lines[1].starts_with("house,3,1,0,"));
  }

  TEST_CASE("tables of energy are the same in all formats and for every number of threads") {
    const Folder folder;
    const std::string in = folder.write("in.city.jsonl", cube_lines({"a", "b", "c"}));
    for (const std::string jobs : {"1", "3"})
      for (const std::string ending : {"csv", "json", "jsonl"})
        REQUIRE(run({"label", in, "-j", jobs, "--table",
                     "energy=" + (folder / ("e" + jobs + "." + ending)), "--table",
                     "envelope=" + (folder / ("f" + jobs + "." + ending))})
                    .exit <= 3);
    for (const std::string file : {"e", "f"})
      for (const std::string ending : {"csv", "json", "jsonl"})
        CHECK(bytes_of(folder / (file + "1." + ending)) ==
              bytes_of(folder / (file + "3." + ending)));
    const json rows = json::parse(bytes_of(folder / "e1.json"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[2]["building"] == "c");
    CHECK(rows[2]["volume_m3"] == 64);
    CHECK(json::parse(lines_of(bytes_of(folder / "e1.jsonl"))[1]) == rows[1]);
    CHECK(json::parse(bytes_of(folder / "f1.json")).size() == 18);
  }

  TEST_CASE("a block without parts has its envelope in the table, which counts as success") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    const Outcome made = run({"label", in, "--table", "envelope"});
    CHECK(made.exit == 0);
    CHECK(lines_of(made.out).size() == 7);
  }

  TEST_CASE("a building without a closed solid has a row with its id and is warned about") {
    const Folder folder;
    auto city = cubes({"a", "assumed", "open"});
    const auto shell_of = [&](const char* id) -> auto& {
      return city["CityObjects"][id]["geometry"][0]["boundaries"][0];
    };
    shell_of("assumed").erase(1);
    while (shell_of("open").size() > 2) shell_of("open").erase(2);
    const std::string in = folder.write("in.city.json", city.dump());
    const Outcome made = run({"label", in, "--table", "energy=" + (folder / "e.json")});
    CHECK(made.exit == 0);
    CHECK(made.err.find("E134 1 building has no closed solid to measure: --table has only its id, "
                        "--extension nothing") != std::string::npos);
    const json rows = json::parse(bytes_of(folder / "e.json"));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0]["volume_m3"] == 64);
    CHECK(rows[0]["closed"] == 1);
    CHECK(rows[1]["volume_m3"] == 64);
    CHECK(rows[1]["closed"] == 0);
    CHECK(rows[2]["building"] == "open");
    CHECK(rows[2]["volume_m3"].is_null());
  }

  TEST_CASE("the wall between two parts of a building is a party wall with --neighbours") {
    const Folder folder;
    auto city = cubes({"p", "q"});
    for (std::size_t i = 8; i < 16; ++i)
      city["vertices"][i][0] = city["vertices"][i][0].get<int>() - 6000;
    for (const char* part : {"p", "q"}) {
      city["CityObjects"][part]["type"] = "BuildingPart";
      city["CityObjects"][part]["parents"] = {"b"};
    }
    city["CityObjects"]["b"] = {{"type", "Building"}, {"children", {"p", "q"}}};
    const std::string in = folder.write("in.city.json", city.dump());
    for (const bool knows : {false, true}) {
      std::vector<std::string> words{"label", in, "--force", "--table",
                                     "energy=" + (folder / "e.json")};
      if (knows) words.emplace_back("--neighbours");
      REQUIRE(run(words).exit == 0);
      for (const json& row : json::parse(bytes_of(folder / "e.json"))) {
        CHECK(row["wall_m2"] == (knows ? 48 : 64));
        CHECK(row["party_wall_m2"] == (knows ? json(16) : json()));
      }
    }
  }

  TEST_CASE("storeys are those that the input states") {
    const Folder folder;
    json city = json::parse(cubes({"a", "b"}).dump());
    city["CityObjects"]["a"]["attributes"]["storeysAboveGround"] = 3;
    const std::string in = folder.write("in.city.json", city.dump());
    run({"label", in, "--table", "energy=" + (folder / "e.json")});
    const json rows = json::parse(bytes_of(folder / "e.json"));
    CHECK(rows[0]["storeys"] == 3);
    CHECK(rows[0]["storeys_source"] == "attribute");
    CHECK(rows[1]["storeys"].is_null());
    CHECK(rows[1]["storeys_source"].is_null());
  }

  TEST_CASE("the energy extension has a zone with its boundaries and openings") {
    const Folder folder;
    const std::string out = folder / "out.city.json", again = folder / "again.city.json";
    REQUIRE(run({"label", sample("house"), "--extension", "energy", "-o", out, "--table",
                 "energy=" + (folder / "e.json"), "--table", "envelope=" + (folder / "f.json")})
                .exit == 0);
    const json city = json::parse(bytes_of(out)), row = json::parse(bytes_of(folder / "e.json"))[0];
    CHECK(city["extensions"]["Energy"]["version"] == "1.1");
    const json& house = city["CityObjects"]["house"];
    CHECK(house["attributes"]["+energy-volume"][0]["energy-type"] == "grossVolume");
    CHECK(house["attributes"]["+energy-volume"][0]["energy-value"] == row["volume_m3"]);
    std::set<std::string> zones, boundaries, openings;
    double outer_m2 = 0;
    for (const auto& [id, object] : city["CityObjects"].items()) {
      const std::string type = object["type"];
      if (type == "+Energy-ThermalZone") zones.insert(id);
      if (type == "+Energy-ThermalOpening") openings.insert(id);
      if (type != "+Energy-ThermalBoundary") continue;
      boundaries.insert(id);
      if (object["attributes"]["energy-thermalBoundaryType"] == "outerWall")
        outer_m2 += object["attributes"]["energy-area"].get<double>();
    }
    REQUIRE(zones.size() == 1);
    const json& zone = city["CityObjects"][*zones.begin()];
    CHECK(zone["parents"] == json::array({"house"}));
    const json& children = house["children"];
    CHECK(std::count(children.begin(), children.end(), *zones.begin()) == 1);
    CHECK(zone["energy-boundedBy"].get<std::set<std::string>>() == boundaries);
    std::set<std::string> contained;
    for (const std::string& id : boundaries)
      for (const json& opening : city["CityObjects"][id].value("energy-contains", json::array()))
        contained.insert(opening);
    CHECK(contained == openings);
    CHECK(static_cast<double>(openings.size()) == row["windows"].get<double>() +
                                                      row["doors"].get<double>() +
                                                      row["roof_windows"].get<double>());
    CHECK(outer_m2 == doctest::Approx(row["wall_m2"].get<double>()).epsilon(1e-9));
    // Once more it replaces what it wrote.
    REQUIRE(run({"label", out, "--extension", "energy", "-o", again}).exit == 0);
    CHECK(bytes_of(again) == bytes_of(out));
  }

  TEST_CASE("in a stream the header declares the energy extension and each line has its zone") {
    const Folder folder;
    const std::string in = folder.write("in.city.jsonl", cube_lines({"a", "b"}));
    const Outcome made = run({"label", in, "--extension", "energy", "-o", "-"});
    const auto lines = lines_of(made.out);
    REQUIRE(lines.size() == 3);
    CHECK(json::parse(lines[0])["extensions"].contains("Energy"));
    for (const std::size_t i : {1, 2}) {
      const json line = json::parse(lines[i]);
      CHECK_FALSE(line.contains("extensions"));
      CHECK(line["CityObjects"].contains(line["id"].get<std::string>() + "-energy-zone"));
    }
  }

  TEST_CASE("a table or an extension that cannot be written is wrong usage") {
    const Folder folder;
    const std::string in = sample("house");
    using Words = std::vector<std::string>;
    for (const Words& more :
         {Words{"--table", "heat"}, Words{"--table", "energy", "--table", "energy"},
          Words{"--table", "energy", "--table", "envelope"}, Words{"--table", "energy=x.txt"},
          Words{"--table", "energy", "-o", "-"}, Words{"--extension", "energy"},
          Words{"--extension", "noise"}, Words{"--extension", "energy", "-o", folder / "out.gml"},
          Words{"--table", "energy", "--existing", "audit"},
          Words{"--table", "energy", "--unheated", "balkony"}, Words{"--unheated", "balcony"}}) {
      Words words{"label", in};
      words.insert(words.end(), more.begin(), more.end());
      CAPTURE(more);
      CHECK(run(words).exit == 2);
    }
  }
}
