#include "tests/cli/command.h"
#include "tests/cli/json_lines.h"
#include "tests/cli/street.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// Gaps of 2 m are closed at 1:10000, of 5 m at 1:25000.
const std::vector<Place> kRow{
    {"a"}, {"b", 10, 0, 8}, {"c", 18, 1, 9, 9, 7}, {"d", 30}, {"far", 90}};

Outcome row_series(const Folder& folder, const json& city, const std::string& scales) {
  return run({"generalise", folder.write("in.city.json", city.dump()), "--neighbours", "-v",
              "--series", scales, "--profile", town_profile(folder), "-o", folder / "s"});
}

json level(const Folder& folder, const std::string& scale) {
  return json::parse(bytes_of(folder / ("s.1-" + scale + ".city.json")));
}

/// A level made from another one, whose file is the only one that is left.
json level_at(const Folder& folder, const std::string& scale, const std::string& from,
              const std::vector<std::string>& others) {
  for (const std::string& other : others)
    std::rename((folder / ("s.1-" + other + ".city.json")).c_str(),
                (folder / ("kept-" + other)).c_str());
  const Outcome made = run(
      {"generalise", "--at", "1:" + scale, "--from", folder / "s", "-o", folder / "at.city.json"});
  CAPTURE(from);
  CHECK(made.exit == 0);
  for (const std::string& other : others)
    std::rename((folder / ("kept-" + other)).c_str(),
                (folder / ("s.1-" + other + ".city.json")).c_str());
  return json::parse(bytes_of(folder / "at.city.json"));
}

/// The polygons of a building by their corners in millimetres, whatever the numbers of vertices;
/// each with its semantic surface.
std::multiset<std::string> polygons_of(const json& city, const std::string& id) {
  std::multiset<std::string> polygons;
  for (const json& geometry : city["CityObjects"][id].value("geometry", json::array())) {
    const bool is_solid = geometry["type"] == "Solid";
    const json& faces = is_solid ? geometry["boundaries"][0] : geometry["boundaries"];
    for (std::size_t i = 0; i < faces.size(); ++i) {
      std::vector<std::string> corners;
      for (const json& v : faces[i][0])
        corners.push_back(city["vertices"][v.get<std::size_t>()].dump());
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      std::string text;
      for (const std::string& corner : corners) text += corner;
      if (geometry.contains("semantics")) {
        const json& values = geometry["semantics"]["values"];
        const json& value = is_solid ? values[0][i] : values[i];
        text += geometry["semantics"]["surfaces"][value.get<std::size_t>()]["type"];
      }
      polygons.insert(text);
    }
  }
  return polygons;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a series makes one of adjoining buildings and gives them back") {
    const Folder folder;
    const Outcome made = row_series(folder, boxes(kRow), "1:1000,1:10000,1:25000");
    CHECK(made.exit == 0);
    CHECK(made.says("a: G421 became one block with 2 others"));
    const json fine = level(folder, "1000"), coarse = level(folder, "10000"),
               coarsest = level(folder, "25000");
    CHECK(coarse["CityObjects"]["a"]["attributes"]["oriel_members"] == "a;b;c");
    CHECK(coarsest["CityObjects"]["a"]["attributes"]["oriel_members"] == "a;b;c;d");
    for (const std::string id : {"b", "c"}) {
      CHECK(polygons_of(coarse, id).empty());
      CHECK(coarse["CityObjects"][id]["attributes"]["oriel_member_of"] == "a");
    }
    CHECK(polygons_of(coarse, "d") == polygons_of(fine, "d"));
    CHECK(polygons_of(coarsest, "d").empty());
    CHECK(polygons_of(coarsest, "far") == polygons_of(fine, "far"));
    for (const std::string scale : {"1000", "10000", "25000"})
      CHECK(run({"validate", folder / ("s.1-" + scale + ".city.json")}).exit == 0);
    const Outcome checked = run({"generalise", "--check", "--from", folder / "s"});
    CHECK(checked.exit == 0);
    CHECK(checked.out.find("5 operations of 4 buildings") != std::string::npos);
    for (const Place& place : kRow) {
      CAPTURE(place.id);
      CHECK(polygons_of(level_at(folder, "2000", "25000", {"1000", "10000"}), place.id) ==
            polygons_of(fine, place.id));
      CHECK(polygons_of(level_at(folder, "12000", "25000", {"1000", "10000"}), place.id) ==
            polygons_of(coarse, place.id));
      CHECK(polygons_of(level_at(folder, "30000", "1000", {"10000", "25000"}), place.id) ==
            polygons_of(coarsest, place.id));
    }
    const json back = level_at(folder, "2000", "25000", {"1000", "10000"});
    for (const Place& place : kRow)
      CHECK(back["CityObjects"][place.id]["attributes"] ==
            fine["CityObjects"][place.id]["attributes"]);
  }

  TEST_CASE("buildings that are part of a block at a level are no fault of its file") {
    const Folder folder;
    json city = boxes(kRow);
    for (const Place& place : kRow) {  // another level of detail stays, and is in nobody's way
      json& geometries = city["CityObjects"][place.id]["geometry"];
      geometries.push_back(geometries[0]);
      geometries[1]["lod"] = "1.2";
    }
    REQUIRE(row_series(folder, city, "1:1000,1:10000").exit == 0);
    CHECK(run({"validate", folder / "s.1-10000.city.json"}).err.find("3 of 3") !=
          std::string::npos);
    CHECK(run({"validate", folder / "s.1-10000.city.json", "--lod", "1.2"}).err.find("5 of 5") !=
          std::string::npos);
    CHECK(run({"generalise", "--check", "--from", folder / "s"}).exit == 0);
    const json at = level_at(folder, "2000", "10000", {"1000"});
    CHECK(at["CityObjects"]["b"]["geometry"].size() == 2);
    const Outcome read = run({"label", folder / "s.1-10000.city.json", "-v", "-o", "-"});
    CHECK(read.exit == 0);
    CHECK(!read.says("E209"));
  }

  TEST_CASE("a block takes along a building that no levels can be drawn of") {
    for (const std::string open : {"a", "b"}) {
      CAPTURE(open);
      const Folder folder;
      json city = boxes(kRow);
      json& shell = city["CityObjects"][open]["geometry"][0]["boundaries"][0];
      shell.erase(3);  // its top and two walls
      shell.erase(1);
      shell.erase(1);
      const Outcome made = row_series(folder, city, "1:1000,1:10000");
      CHECK(made.exit == 3);
      CHECK(made.says(open + ": G404"));
      CHECK(polygons_of(level(folder, "1000"), open) == polygons_of(city, open));
      CHECK(level(folder, "10000")["CityObjects"]["a"]["attributes"]["oriel_members"] == "a;b;c");
      CHECK(polygons_of(level(folder, "10000"), "b").empty());
      CHECK(run({"generalise", "--check", "--from", folder / "s"}).exit == 0);
      CHECK(polygons_of(level_at(folder, "2000", "10000", {"1000"}), open) ==
            polygons_of(city, open));
    }
  }

  TEST_CASE("a series of a town has the same blocks in streams, shards and threads") {
    const Folder folder;
    const std::string whole = town(folder, 8), profile = town_profile(folder);
    const std::vector<std::string> lines = lines_of(bytes_of(whole));
    const auto made = [&](const std::string& from, const std::string& to,
                          const std::vector<std::string>& more) {
      std::vector<std::string> call{"generalise", from,    "--series", "1:2500,1:10000",
                                    "--profile",  profile, "-o",       folder / to};
      call.insert(call.end(), more.begin(), more.end());
      CHECK(run(call).exit == 0);
      CHECK(run({"generalise", "--check", "--from", folder / to}).exit == 0);
      return bytes_of(folder / (to + ".1-10000.city.jsonl"));
    };
    const std::string at_once = made(whole, "one", {"--neighbours"});
    CHECK(at_once.find("oriel_member_of") != std::string::npos);
    CHECK(at_once == made(whole, "two", {"--neighbours", "-j", "2"}));
    CHECK(bytes_of(folder / "one.oplog.jsonl") == bytes_of(folder / "two.oplog.jsonl"));
    std::string first, second = lines[0] + "\n";
    for (std::size_t i = 0; i < lines.size(); ++i)
      (i < lines.size() / 2 ? first : second) += lines[i] + "\n";
    const std::string of_first =
        made(folder.write("f.city.jsonl", first), "first", {"--neighbours=" + whole});
    const std::string of_second =
        made(folder.write("g.city.jsonl", second), "second", {"--neighbours=" + whole});
    CHECK(at_once == of_first + of_second.substr(of_second.find('\n') + 1));
    CHECK(run({"generalise", "--at", "1:2500", "--from", folder / "one", "-o",
               folder / "at.city.jsonl"})
              .exit == 0);
    CHECK(run({"validate", folder / "one.1-10000.city.jsonl"}).exit == 0);
  }

  TEST_CASE("tiles have no blocks and say why") {
    const Folder folder;
    const Outcome tiles = run({"tiles", folder.write("in.city.json", boxes(kRow).dump()),
                               "--profile", town_profile(folder), "-o", folder / "tiles"});
    CHECK(tiles.exit == 4);
    CHECK(tiles.says("R278"));
  }
}
