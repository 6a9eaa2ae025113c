#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <cmath>
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

std::multiset<std::string> lods_of(const json& city, const std::string& id) {
  std::multiset<std::string> lods;
  for (const json& geometry : city["CityObjects"][id]["geometry"])
    lods.insert(geometry["lod"].get<std::string>());
  return lods;
}

template <class Visit>
void for_each_edge(const json& city, const std::string& id, const Visit& visit) {
  for (const json& shell : city["CityObjects"][id]["geometry"][0]["boundaries"])
    for (const json& polygon : shell)
      for (const json& ring : polygon)
        for (std::size_t i = 0; i < ring.size(); ++i)
          visit(city["vertices"][ring[i].get<std::size_t>()],
                city["vertices"][ring[(i + 1) % ring.size()].get<std::size_t>()]);
}

/// Samples are in micrometres.
double distance_um(const json& p, const json& q) {
  return std::hypot(p[0].get<double>() - q[0].get<double>(),
                    p[1].get<double>() - q[1].get<double>(),
                    p[2].get<double>() - q[2].get<double>());
}

/// A cube of 4 m with a chimney of 1 m at its edge, against the wall of a neighbour of 8 m.
json with_neighbour() {
  json city = cubes({"a", "b"});
  for (std::size_t v = 8; v < 16; ++v) {
    json& point = city["vertices"][v];
    point = {point[0].get<int>() - 6000, point[1], 2 * point[2].get<int>()};
  }
  for (const int z : {4000, 5000})  // vertices 16 to 19 at the foot, 20 to 23 at the top
    for (const auto& [x, y] :
         std::vector<std::pair<int, int>>{{3000, 1000}, {4000, 1000}, {4000, 2000}, {3000, 2000}})
      city["vertices"].push_back({x, y, z});
  const std::vector<std::vector<int>> rings{{0, 2, 3, 1},     {4, 5, 17, 16, 19, 18, 7, 6},
                                            {0, 1, 5, 4},     {1, 3, 7, 18, 17, 5},
                                            {3, 2, 6, 7},     {2, 0, 4, 6},
                                            {20, 21, 22, 23}, {16, 17, 21, 20},
                                            {17, 18, 22, 21}, {18, 19, 23, 22},
                                            {19, 16, 20, 23}};
  json shell = json::array();
  for (const std::vector<int>& ring : rings) shell.push_back(json::array({ring}));
  city["CityObjects"]["a"]["geometry"][0]["boundaries"] = json::array({shell});
  return city;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a profile of blocks at a scale is a warning and makes none") {
    const Folder folder;
    const Outcome made = run(
        {"generalise", sample("house"), "--scale", "1:10000", "--profile", "lod:1.2", "-o", "-"});
    CHECK(made.exit == 0);
    CHECK(made.says("R276 the profile lod:1.2 makes blocks"));
    CHECK(run({"generalise", sample("block"), "--series", "1:500,1:5000", "--profile", "lod:1.3",
               "-o", folder / "s"})
              .says("R276"));
    CHECK(run({"tiles", sample("block"), "--profile", "lod:1.3", "-o", folder / "t"}).says("R276"));
    CHECK_FALSE(
        run({"generalise", sample("house"), "--profile", "lod:1.2", "-o", "-"}).says("R276"));
  }

  TEST_CASE("level 3 of citygml keeps windows and doors, which make it level 3") {
    const auto kept = [](const std::string& level) {
      const Outcome made =
          run({"generalise", sample("house"), "--profile", "citygml:" + level, "-o", "-"});
      REQUIRE(made.exit == 0);
      const json city = json::parse(made.out);
      std::map<std::string, int> counts;
      for (const json& surface :
           city["CityObjects"]["house"]["geometry"][0]["semantics"]["surfaces"])
        ++counts[surface["type"].get<std::string>()];
      return counts;
    };
    auto three = kept("3"), two = kept("2");
    CHECK(three["Window"] == 16);
    CHECK(three["Door"] == 2);
    CHECK(two["Window"] + two["Door"] == 0);
  }

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
    for (const std::string lod : {"2", "9", "3.3", "two", ""}) {
      const Outcome unknown = run({"generalise", sample("block"), "--to-lod", lod, "-o", "-"});
      CAPTURE(unknown.err);
      CHECK(unknown.exit == 2);
      CHECK(unknown.says("--to-lod: R275 " +
                         (lod.empty() ? "a level is needed" : "there is no level '" + lod + "'") +
                         "; the levels of 'lod' are 2.0, 1.3, 1.2, 1.0\n"));
    }
    const Outcome none = run({"generalise", sample("block"), "--profile", "plateau", "-o", "-"});
    CHECK(none.exit == 2);
    CHECK(none.says("--profile: R275 a level is needed; the levels of 'plateau' are "));
  }

  TEST_CASE("a building with an outline only is rejected with E205 by every command and no more") {
    const Folder folder;
    json city = cubes({"a", "b"});
    json& geometry = city["CityObjects"]["a"]["geometry"][0];
    geometry = {{"type", "MultiSurface"},
                {"lod", "0"},
                {"boundaries", json::array({geometry["boundaries"][0][0]})}};
    const std::string in = folder.write("in.city.json", city.dump());
    const std::string out = folder / "out.city.json";
    const std::vector<std::vector<std::string>> commands{
        {"segment", "--json"},
        {"label", "-o", out},
        {"generalise", "--scale", "1:1000", "-o", out},
        {"generalise", "--to-lod", "1.2", "-o", out},
        {"generalise", "--series", "1:500,1:1000", "-o", folder / "series"},
        {"repair", "-o", out},
        {"view", "-o", folder / "page.html"},
        {"explain"}};
    for (std::vector<std::string> command : commands) {
      command.insert(command.begin() + 1, in);
      const Outcome outcome = run(command);
      CAPTURE(command);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 3);
      CHECK(
          outcome.err.starts_with("error: a: E205 has no geometry above lod 0, which is an "
                                  "outline on the ground or of the roof; expected lod 1 or "
                                  "higher\n"));
      CHECK_FALSE(outcome.says("G404"));
      CHECK_FALSE(outcome.says("E301"));
      CHECK_FALSE(outcome.says(" b: "));
    }
    CHECK(run({"label", in, "--lod", "0", "--id", "a", "-o", out}).exit == 0);
    const Outcome asked =
        run({"generalise", in, "--lod", "0", "--id", "a", "--scale", "1:1000", "-o", out});
    CHECK(asked.exit == 3);
    CHECK(asked.says("error: a: E205 has no walls and roof at lod 0"));
    CHECK_FALSE(asked.says("G404"));
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
    // At this scale no openings are left; what is left is labelled as it was.
    CHECK(figures["openings_before"] == 18);
    CHECK(figures["openings_after"] == 0);
    CHECK(figures["openings_kept"] == 0);
    CHECK(figures["rows_after"] == 0);
    CHECK(figures["smallest_edge_m_after"] > figures["smallest_edge_m_before"]);
    CHECK(figures["smallest_edge_map_mm"].get<double>() ==
          doctest::Approx(figures["smallest_edge_m_after"].get<double>() / 5));
  }

  TEST_CASE("what is drawn unchanged keeps all openings, their rows and its labels") {
    const Folder folder;
    REQUIRE(run({"generalise", sample("house"), "--scale", "1:500", "--metrics", folder / "m.jsonl",
                 "-o", folder / "out.city.json"})
                .exit == 0);
    const json figures = json::parse(bytes_of(folder / "m.jsonl"));
    CHECK(figures["hausdorff_m"] == 0);
    CHECK(figures["openings_kept"] == 1);
    CHECK(figures["openings_area_kept"] == 1);
    CHECK(figures["rows_after"] == figures["rows_before"]);
    CHECK(figures["symmetry_after"] == figures["symmetry_before"]);
    CHECK(figures["labels_found_again"] == 1);
    CHECK(figures["labels"]["chimney"] == json{{"drawn", 1}, {"found", 1}});
  }

  TEST_CASE("a map profile decides of what the pack has no entry for") {
    const Outcome without = run({"generalise", sample("house"), "--scale", "1:2500", "-o", "-"});
    const Outcome with =
        run({"generalise", sample("house"), "--scale", "1:2500", "--profile", "map", "-o", "-"});
    REQUIRE(without.exit == 0);
    REQUIRE(with.exit == 0);
    CHECK(with.out.size() <= without.out.size());
  }

  TEST_CASE("for flow simulation no edge is too short but those that are told") {
    for (const std::string name : {"house", "row", "block", "hip"}) {
      const Outcome made = run({"generalise", sample(name), "--profile", "cfd", "-o", "-"});
      REQUIRE(made.exit == 0);
      const json city = json::parse(made.out);
      CHECK(lods_of(city, name) == std::multiset<std::string>{"2.2"});
      std::set<std::pair<json, json>> edges;
      for_each_edge(city, name, [&](const json& p, const json& q) {
        if (distance_um(p, q) < 199'999) edges.emplace(std::min(p, q), std::max(p, q));
      });
      std::size_t told = 0;
      std::istringstream lines(made.err);
      for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find("G415 has "); at != std::string::npos) {
          told += std::stoul(line.substr(at + 9));
          CHECK(line.find("it was refused, G401") != std::string::npos);
        }
      CHECK(edges.size() == told);
      for (const json& surface : city["CityObjects"][name]["geometry"][0]["semantics"]["surfaces"])
        CHECK((surface["type"] != "Window" && surface["type"] != "Door"));
    }
  }

  TEST_CASE("an STL for flow simulation is closed and has a solid for each class of surfaces") {
    const Folder folder;
    const std::string out = folder / "house.stl";
    REQUIRE(run({"generalise", sample("house"), "--profile", "cfd", "-o", out}).exit == 0);
    std::istringstream lines(bytes_of(out));
    std::multiset<std::string> solids;
    std::map<std::pair<std::string, std::string>, int> balance;
    std::vector<std::string> corners;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("solid ")) solids.insert(line.substr(6));
      if (line.starts_with("vertex ")) corners.push_back(line);
      if (line != "endloop") continue;
      REQUIRE(corners.size() == 3);
      for (std::size_t i = 0; i < 3; ++i) {
        ++balance[{corners[i], corners[(i + 1) % 3]}];
        --balance[{corners[(i + 1) % 3], corners[i]}];
      }
      corners.clear();
    }
    CHECK((solids == std::multiset<std::string>{"GroundSurface", "OuterCeilingSurface",
                                                "RoofSurface", "WallSurface"}));
    CHECK(balance.size() > 100);
    for (const auto& [edge, count] : balance) CHECK(count == 0);
  }

  TEST_CASE("what a pack says must not change does not, with and without a profile") {
    const Folder folder;
    const std::string pack =
        folder.write("strict.yaml",
                     "schema: oriel/1\npack: {name: strict, version: 1.0.0}\nextends: "
                     "residential\ninvariants: {volume-pct: 0.001}\n");
    const auto made = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"generalise", sample("house"), "--scale", "1:10000", "-o",
                                         "-"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run(arguments);
    };
    CHECK_FALSE(made({}).says("G405"));
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--profile", "map"}}) {
      std::vector<std::string> with_pack{"--rules", pack};
      with_pack.insert(with_pack.end(), more.begin(), more.end());
      const Outcome kept = made(with_pack);
      CHECK(kept.exit == 0);
      CHECK(kept.says("G405 is not omitted at 1:10000: the volume would change by"));
    }
  }

  TEST_CASE("the finer a level of PLATEAU the more openings stay") {
    std::vector<std::size_t> sizes;
    for (const std::string level : {"3.0", "3.1", "3.2", "3.3"}) {
      const Outcome made =
          run({"generalise", sample("house"), "--profile", "plateau:" + level, "-o", "-"});
      REQUIRE(made.exit == 0);
      const json city = json::parse(made.out);
      CHECK(lods_of(city, "house") == std::multiset<std::string>{level});
      sizes.push_back(city["CityObjects"]["house"]["geometry"][0]["boundaries"][0].size());
    }
    CHECK(std::ranges::is_sorted(sizes));
    CHECK(sizes[0] < sizes[2]);
  }

  TEST_CASE("what stands against a neighbour stays where a profile says so") {
    const Folder folder;
    const std::string city = folder.write("city.json", with_neighbour().dump());
    const auto made = [&](const std::string& invariants) {
      const std::string profile = folder.write(
          "p.yaml",
          "schema: oriel-profile/1\nprofile: {name: p, version: 1.0.0}\nlevels:\n  any:\n" +
              std::string("    form: as-is\n    map-mm: 0.5\n    verdicts: {point: omit}\n") +
              invariants);
      return run({"generalise", city, "--scale", "1:3000", "--profile", profile, "-o", "-"});
    };
    const Outcome free = made(""), bound = made("    invariants: {party-walls-pct: 1}\n");
    CHECK(free.says("1 chimney left out"));
    CHECK_FALSE(free.says("G405"));
    CHECK(bound.says("G405 is not omitted at 1:3000: its party walls would change by 5.88 %"));
    CHECK_FALSE(bound.says("left out"));
  }

  TEST_CASE("the least edge of a profile is a parameter") {
    const Outcome fine =
        run({"generalise", sample("house"), "--profile", "cfd", "--edge-min", "0.01", "-o", "-"});
    const Outcome coarse =
        run({"generalise", sample("house"), "--profile", "cfd", "--edge-min", "0.5", "-o", "-"});
    REQUIRE(fine.exit == 0);
    REQUIRE(coarse.exit == 0);
    CHECK(coarse.out.size() < fine.out.size());
    CHECK_FALSE(fine.says("G415"));
    const Outcome told =
        run({"generalise", sample("hip"), "--profile", "cfd", "--edge-min", "0.5", "-o", "-"});
    CHECK(told.says("warning: hip: G415 has 4 edges below 0.5 m left"));
    CHECK(told.says("G416 has 1 gaps below 0.5 m left, the least of 0.350 m"));
    CHECK(run({"generalise", sample("house"), "--scale", "1:500", "--edge-min", "1", "-o", "-"})
              .exit == 2);
    CHECK(run({"generalise", sample("house"), "--profile", "cfd", "--edge-min", "0", "-o", "-"})
              .exit == 2);
    CHECK(run({"generalise", sample("house"), "--profile", "plateau", "-o", "-"}).says("R275"));
    const Outcome noted = run(
        {"generalise", sample("house"), "--scale", "1:2500", "--profile", "map", "-o", "-", "-v"});
    CHECK(noted.exit == 0);
    for (const std::string code : {"warning: house: G415", "warning: house f"})
      CHECK_FALSE(noted.says(code + " G415"));
  }

  TEST_CASE("new edges shorter than the map shows are told without a profile, too") {
    // The hipped roof has a short ridge, of which the chimney hid a part.
    const auto told = [](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"generalise", sample("hip"), "--scale", "1:50000",
                                         "-o",         "-",           "-v"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run(arguments);
    };
    const Outcome without = told({}), with = told({"--profile", "map"});
    const std::string text =
        "note: hip: G415 has 1 edges below 6.25 m of parts that stay unchanged";
    CHECK(without.says(text));
    CHECK(with.says(text));
  }

  TEST_CASE("edges of blocks are told with the reason why they stay") {
    const Outcome made = run({"generalise", sample("hip"), "--to-lod", "1.2", "-o", "-", "-v"});
    CHECK(made.exit == 0);
    CHECK(made.says("note: hip: G415 has 28 edges below 2 m left"));
    CHECK(made.says(": blocks keep the footprint and the heights of the roof"));
  }

  TEST_CASE(
      "a strip that is laid bare on a surveyed roof goes, or the reason why it stays is told") {
    ORIEL_NEEDS_SHARED(shared);
    const std::string tile = (shared / "data/3dbag/tile_5910.city.jsonl").string();
    const auto made = [&](const std::string& id) {
      return run({"generalise", tile, "--lod", "2.2", "--id", "NL.IMBAG.Pand." + id + "-0",
                  "--scale", "1:10000", "-v", "-o", "-"});
    };
    const Outcome cleared = made("0503100000019700");
    REQUIRE(cleared.exit == 0);
    CHECK(cleared.says("1 of 1 building"));
    CHECK_FALSE(cleared.says("G415"));
    CHECK(
        run({"validate", "-", "--from", "cityjsonseq", "--lod", "2.2"}, {.in = cleared.out}).exit ==
        0);
    const Outcome left = made("0503100000025030");
    REQUIRE(left.exit == 0);
    CHECK(left.says("G415 has 1 edges below 1.25 m left, "));
    std::istringstream lines(left.err);
    for (std::string line; std::getline(lines, line);) {
      const bool is_left = line.find("G415 has ") != std::string::npos &&
                           line.find(" m left, ") != std::string::npos;
      if (!is_left) continue;
      const bool is_refused = line.find("): it was refused, ") != std::string::npos;
      CHECK((is_refused || line.find("): cannot remove the narrow facet: ") != std::string::npos));
      CHECK(line.starts_with(is_refused ? "note: " : "warning: "));
    }
  }
}
