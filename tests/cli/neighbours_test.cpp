#include "tests/cli/command.h"
#include "tests/cli/street.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// What is left of boxes at 1:10000 with groups.
Outcome grouped(const Folder& folder, const std::vector<Place>& places,
                const std::string& more = "gap-mm: 0.2") {
  return run({"generalise", folder.write("in.city.json", boxes(places).dump()), "--neighbours",
              "-v", "--scale", "1:10000", "--profile", town_profile(folder, more), "-o",
              folder / "out.city.json"});
}

json output_of(const Folder& folder) { return json::parse(bytes_of(folder / "out.city.json")); }

/// A tile has a label, in its table of features.
bool has_tile_with(const std::string& tileset, const std::string& label) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(tileset))
    if (entry.path().extension() == ".glb" &&
        bytes_of(entry.path()).find(label) != std::string::npos)
      return true;
  return false;
}

/// The lines after the header, sorted.
std::vector<std::string> sorted_lines(const std::string& path) {
  std::vector<std::string> lines = lines_of(bytes_of(path));
  if (!lines.empty()) lines.erase(lines.begin());
  std::ranges::sort(lines);
  return lines;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("buildings name their neighbours and walls say what lies before them") {
    const Folder folder;
    const std::string city =
        folder.write("in.city.json", boxes({{"a"}, {"b", 10}, {"c", 30}}).dump());
    REQUIRE(run({"label", city, "--neighbours", "-o", folder / "out.city.json"}).exit <= 3);
    const json out = output_of(folder);
    CHECK(out["CityObjects"]["a"]["attributes"]["oriel_neighbours"] == "b");
    CHECK(out["CityObjects"]["a"]["attributes"]["oriel_party_walls_m2"] == 60);
    CHECK(out["CityObjects"]["c"]["attributes"]["oriel_neighbours"] == "");
    std::map<std::string, int> faces;
    for (const json& surface : out["CityObjects"]["a"]["geometry"][0]["semantics"]["surfaces"])
      if (surface["type"] == "WallSurface")
        ++faces[surface["oriel_party_wall"] ? "party" : surface.value("oriel_faces", "nothing")];
    CHECK(faces == std::map<std::string, int>{{"party", 1}, {"street", 3}});
    const Outcome plain = run({"label", city, "-o", "-"});
    CHECK(plain.out.find("oriel_neighbours") == std::string::npos);
    CHECK(plain.out.find("oriel_party_wall") == std::string::npos);
  }

  TEST_CASE("walls with a reason say what lies before them too") {
    const Folder folder;
    const std::string city = folder.write("in.city.json", boxes({{"a"}, {"b", 10}}).dump());
    REQUIRE(
        run({"label", city, "--neighbours", "--explain", "-o", folder / "out.city.json"}).exit <=
        3);
    const json out = output_of(folder);
    int walls = 0;
    for (const json& surface : out["CityObjects"]["a"]["geometry"][0]["semantics"]["surfaces"])
      if (surface["type"] == "WallSurface") {
        ++walls;
        CHECK(surface.contains("oriel_why"));
        CHECK(surface.contains("oriel_party_wall"));
      }
    CHECK(walls == 4);
  }

  TEST_CASE("neighbours are found whatever the shards and threads and orders") {
    const Folder folder;
    const std::string whole = town(folder, 20);
    const std::string profile = town_profile(folder);
    const std::vector<std::string> lines = lines_of(bytes_of(whole));
    std::string one = lines[0] + "\n", other = one;
    for (std::size_t i = lines.size() - 1; i > 0; --i)
      (i % 3 == 0 ? one : other) += lines[i] + "\n";
    const std::vector<std::string> shards{folder.write("one.city.jsonl", one),
                                          folder.write("other.city.jsonl", other)};
    for (const std::vector<std::string>& call :
         {std::vector<std::string>{"label"},
          std::vector<std::string>{"generalise", "--scale", "1:10000", "--profile", profile}}) {
      const auto made = [&](const std::string& from, const std::vector<std::string>& more) {
        std::vector<std::string> all = call;
        const std::string to = replaced(from, ".city.jsonl", ".out.city.jsonl");
        all.insert(all.end(), {from, "-o", to});
        all.insert(all.end(), more.begin(), more.end());
        CHECK(run(all).exit == 0);
        return sorted_lines(to);
      };
      const auto at_once = made(whole, {"--neighbours"});
      CHECK(at_once == made(whole, {"--neighbours", "-j", "3"}));
      auto in_shards = made(shards[0], {"--neighbours=" + whole});
      std::ranges::copy(made(shards[1], {"--neighbours=" + whole, "-j", "2"}),
                        std::back_inserter(in_shards));
      std::ranges::sort(in_shards);
      CHECK(at_once == in_shards);
    }
  }

  TEST_CASE("a stream from stdin needs a file that has its neighbours") {
    const Folder folder;
    const std::string whole = town(folder, 4);
    const oriel::test::Surroundings piped{.in = bytes_of(whole)};
    const Outcome refused = run({"label", "-", "--neighbours"}, piped);
    CHECK(refused.exit == 2);
    CHECK(refused.says("--neighbours=FILE"));
    const Outcome made = run({"label", "-", "--neighbours=" + whole}, piped);
    CHECK(made.exit == 0);
    CHECK(made.out.find("\"oriel_neighbours\":\"house-000001;house-000003\"") != std::string::npos);
    CHECK(run({"label", whole, "--neighbours=" + (folder / "none.city.jsonl"), "-o",
               folder / "o.city.jsonl"})
              .says("E101"));
    CHECK(folder.names() == std::vector<std::string>{"town.city.jsonl"});
  }

  TEST_CASE("explain and view look around as label does") {
    const Folder folder;
    const std::string whole = town(folder, 2);
    const std::string pack = folder.write(
        "street.yaml",
        "schema: oriel/1\npack: {name: street, version: 1.0.0}\nclasses: {window: {}}\nrules:\n"
        "  - {id: window, label: window, require: [sense = hole, faces_street]}\n");
    const auto windows = [&](const std::vector<std::string>& call) {
      std::vector<std::string> all = call;
      all.insert(all.end(), {whole, "--rules", pack});
      const Outcome made = run(all);
      CHECK(made.exit == 0);
      return made;
    };
    CHECK(windows({"label", "--neighbours", "-o", folder / "o.city.jsonl"}).says(" window"));
    CHECK(windows({"explain", "--neighbours"}).out.find("window 1") != std::string::npos);
    CHECK(windows({"explain"}).out.find("window 1") == std::string::npos);
    CHECK(windows({"view", "--neighbours", "-o", folder / "page.html"}).says(" window"));
    CHECK(!windows({"view", "-o", folder / "alone.html"}).says(" window"));
  }

  TEST_CASE("what a file of neighbours lost is told and costs nothing else") {
    const Folder folder;
    const std::string whole = town(folder, 2), empty = folder.write("empty.city.jsonl", "");
    const std::string cut = folder.write("cut.city.jsonl", bytes_of(whole).substr(0, 3000));
    for (const auto& [file, code] : {std::pair{empty, "E102"}, {cut, "E10"}}) {
      CAPTURE(file);
      const Outcome made =
          run({"label", whole, "--neighbours=" + file, "-o", folder / "o.city.jsonl"});
      CHECK(made.exit == 0);
      CHECK(made.says("warning: "));
      CHECK(made.says(code));
    }
  }

  TEST_CASE("a row of houses of like height becomes one block") {
    const Folder folder;
    const Outcome made =
        grouped(folder, {{"a"}, {"b", 10, 0, 8}, {"c", 18, 1, 9, 9, 7}, {"far", 50}});
    CHECK(made.exit == 0);
    CHECK(made.says("a: G421 became one block with 2 others"));
    CHECK(made.says("c: G421 became part of 'a'"));
    const json out = output_of(folder);
    CHECK(ids_in(out) == std::set<std::string>{"a", "far"});
    CHECK(out["CityObjects"]["a"]["attributes"]["oriel_members"] == "a;b;c");
    CHECK(run({"validate", folder / "out.city.json"}).exit == 0);
  }

  TEST_CASE("gaps narrower than the map shows are closed") {
    const Folder folder;
    const std::vector<Place> pair{{"a"}, {"b", 11.9}};
    CHECK(grouped(folder, pair).exit == 0);
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a"});
    CHECK(grouped(folder, pair, "gap-mm: 0.18").exit == 0);
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a", "b"});
    // A third building stands in the gap, and is too high to join.
    CHECK(grouped(folder, {{"a"}, {"b", 11.9}, {"tower", 10.5, 2, 1, 5, 40}}).exit == 0);
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a", "b", "tower"});
  }

  TEST_CASE("walls that are centimetres apart leave no crack in a block") {
    const Folder folder;
    const Outcome made = grouped(folder, {{"a"}, {"b", 10.04}}, "like-height-m: 2");
    CHECK(made.says("E178"));
    const json out = output_of(folder);
    CHECK(ids_in(out) == std::set<std::string>{"a"});
    CHECK(out["CityObjects"]["a"]["geometry"][0]["boundaries"][0].size() == 6);
  }

  TEST_CASE("houses of different heights stay by themselves") {
    const Folder folder;
    const Outcome made = grouped(folder, {{"a"}, {"b", 10, 0, 10, 10, 10}});
    CHECK(made.exit == 0);
    CHECK(made.says("b: G423 adjoins 'a'"));
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a", "b"});
  }

  TEST_CASE("a group whose block would be no valid solid stays as it was") {
    const Folder folder;
    std::vector<Place> ring;
    for (const auto& [x, y] :
         std::vector<std::pair<int, int>>{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}})
      ring.push_back({"h" + std::to_string(x) + std::to_string(y), 10.0 * x, 10.0 * y});
    const Outcome made = grouped(folder, ring);
    CHECK(made.exit == 0);
    CHECK(made.says("G422"));
    CHECK(ids_in(output_of(folder)).size() == ring.size());
  }

  TEST_CASE("neighbours that overlap are told and nothing is lost") {
    const Folder folder;
    const std::string city =
        folder.write("in.city.json", boxes({{"a"}, {"b", 9}, {"in", 2, 2, 3, 3, 3}}).dump());
    const Outcome made = run({"label", city, "--neighbours", "-v", "-o", folder / "out.city.json"});
    CHECK(made.says("E175 overlaps 'b'"));
    CHECK(made.says("in: E176 stands in 'a'"));
    CHECK(ids_in(output_of(folder)).size() == 3);
  }

  TEST_CASE("a part of a building that joins a group takes its building along") {
    const Folder folder;
    json city = boxes({{"a"}, {"b-0", 10}});
    city["CityObjects"]["b-0"]["type"] = "BuildingPart";
    city["CityObjects"]["b-0"]["parents"] = {"b"};
    city["CityObjects"]["b-0"]["children"] = {"b-0-sign"};
    city["CityObjects"]["b"] = {{"type", "Building"}, {"children", {"b-0"}}};
    city["CityObjects"]["b-0-sign"] = {{"type", "BuildingInstallation"}, {"parents", {"b-0"}}};
    CHECK(run({"generalise", folder.write("in.city.json", city.dump()), "--neighbours", "--scale",
               "1:10000", "--profile", town_profile(folder), "-o", folder / "out.city.json"})
              .exit == 0);
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a"});
  }

  TEST_CASE("groups ask for neighbours and a scale") {
    const Folder folder;
    const std::string city = folder.write("in.city.json", boxes({{"a"}, {"b", 10}}).dump());
    const std::string profile = town_profile(folder);
    CHECK(run({"generalise", city, "--scale", "1:10000", "--profile", profile, "-o", "-"})
              .says("R277"));
    CHECK(run({"generalise", city, "--series", "1:5000,1:10000", "--profile", profile, "-o",
               folder / "s"})
              .says("R277"));
    CHECK(run({"generalise", city, "--neighbours", "--scale", "1:10000", "--profile", profile, "-o",
               folder / "x.obj"})
              .exit == 2);
    CHECK(run({"generalise", city, "--neighbours", "--scale", "1:5000", "--profile", profile, "-o",
               folder / "out.city.json"})
              .exit == 0);
    CHECK(ids_in(output_of(folder)) == std::set<std::string>{"a", "b"});
  }

  TEST_CASE("tiles are labelled with their neighbours in view") {
    const Folder folder;
    const std::string city = town(folder, 6);
    const std::string pack =
        folder.write("front.yaml",
                     "schema: oriel/1\npack: {name: front, version: 1.0.0}\nclasses: {front: {}}\n"
                     "rules:\n  - {id: f, label: front, require: faces_street}\n");
    const auto tiled = [&](const std::string& out, const std::vector<std::string>& more) {
      std::vector<std::string> call{"tiles", city,         "--rules",  pack,
                                    "-o",    folder / out, "--scales", "1:500"};
      call.insert(call.end(), more.begin(), more.end());
      return run(call);
    };
    const Outcome alone = tiled("alone", {}), beside = tiled("beside", {"--neighbours"});
    CHECK(alone.exit <= 3);
    CHECK(beside.exit <= 3);
    CHECK_FALSE(has_tile_with(folder / "alone", "front"));
    CHECK(has_tile_with(folder / "beside", "front"));
    // Half of it, with the whole town to look at.
    const std::vector<std::string> lines = lines_of(bytes_of(city));
    const std::string half =
        folder.write("half.city.jsonl", lines[0] + "\n" + lines[1] + "\n" + lines[2] + "\n");
    CHECK(run({"tiles", half, "--rules", pack, "-o", folder / "half", "--scales", "1:500",
               "--neighbours=" + city})
              .exit <= 3);
    CHECK(has_tile_with(folder / "half", "front"));
    CHECK(run({"tiles", half, "-o", folder / "x", "--neighbours=" + folder / "no.city.json"})
              .says("E101"));
  }
}
