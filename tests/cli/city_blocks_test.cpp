#include "tests/cli/command.h"
#include "tests/cli/street.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

Outcome united(const Folder& folder, const json& city, const std::vector<std::string>& more = {}) {
  std::vector<std::string> call{"generalise",   folder.write("in.city.json", city.dump()),
                                "--neighbours", "-v",
                                "--scale",      "1:10000",
                                "--profile",    town_profile(folder),
                                "-o",           folder / "out.city.json"};
  call.insert(call.end(), more.begin(), more.end());
  return run(call);
}

json united_city(const Folder& folder) { return json::parse(bytes_of(folder / "out.city.json")); }

/// How many surfaces of each type a building has.
std::map<std::string, int> surface_types(const json& city, const std::string& id) {
  std::map<std::string, int> types;
  const json& semantics = city["CityObjects"][id]["geometry"][0]["semantics"];
  for (const json& number : semantics["values"][0])
    ++types[semantics["surfaces"][number.get<std::size_t>()]["type"].get<std::string>()];
  return types;
}

double highest(const json& city, const std::string& id) {
  double top = -1e9;
  for (const json& polygon : city["CityObjects"][id]["geometry"][0]["boundaries"][0])
    for (const json& v : polygon[0])
      top = std::max(top, city["vertices"][v.get<std::size_t>()][2].get<double>() *
                              city["transform"]["scale"][2].get<double>());
  return top;
}

std::string roads(const Folder& folder, const std::string& geometry,
                  const std::string& properties = "{}") {
  return folder.write(
      "roads.geojson",
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": )" +
          properties + R"(, "geometry": )" + geometry + "}]}");
}

const std::string kAlley =
    R"({"type": "Polygon", "coordinates": [[[10.5,-5],[11,-5],[11,15],[10.5,15],[10.5,-5]]]})";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("gables whose ridges run along their row become one gable") {
    const Folder folder;
    const json row = boxes(
        {{"a", 0, 0, 10, 10, 6, 9}, {"b", 10, 0, 10, 10, 6.5, 10}, {"c", 20, 0, 10, 10, 6, 9}});
    const Outcome made = united(folder, row);
    CHECK(made.exit == 0);
    CHECK(made.says("a: G421 became one block with 2 others, under one gable"));
    const json out = united_city(folder);
    CHECK(surface_types(out, "a") ==
          std::map<std::string, int>{{"GroundSurface", 1}, {"RoofSurface", 2}, {"WallSurface", 4}});
    CHECK(highest(out, "a") == doctest::Approx(9.333));
    CHECK(run({"validate", folder / "out.city.json"}).exit == 0);
  }

  TEST_CASE("a block is flat where its roofs are not one row of gables") {
    // Gables across the row; flat roofs on most of the ground; an outline with a corner too many.
    for (const std::vector<Place>& row : std::vector<std::vector<Place>>{
             {{"a", 0, 0, 10, 10, 6, 9}, {"b", 0, 10, 10, 10, 6, 9}, {"c", 0, 20, 10, 10, 6, 9}},
             {{"a", 0, 0, 10, 10, 6, 9}, {"b", 10, 0, 20, 10, 8}},
             {{"a", 0, 0, 10, 10, 6, 9}, {"b", 10, 0, 10, 30, 6, 9}}}) {
      const Folder folder;
      CHECK(united(folder, boxes(row)).exit == 0);
      const json out = united_city(folder);
      CHECK(ids_in(out).size() == 1);
      CHECK(surface_types(out, "a")["RoofSurface"] == 1);
      CHECK(run({"validate", folder / "out.city.json"}).exit == 0);
    }
  }

  TEST_CASE("of a row of detached houses some stand for all, with both ends") {
    const Folder folder;
    std::vector<Place> row;
    for (int i = 0; i < 5; ++i) row.push_back({"h" + std::to_string(i), 20.0 * i});
    const std::string city = folder.write("in.city.json", boxes(row).dump());
    const std::string profile = town_profile(folder, "gap-mm: 0.2, typify: {ratio: 0.5}");
    const auto generalised = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call{"generalise", city, "--neighbours", "-v", "--profile", profile};
      call.insert(call.end(), more.begin(), more.end());
      return run(call);
    };
    CHECK(generalised({"--scale", "1:20000", "-o", folder / "out.city.json"}).exit == 0);
    CHECK(ids_in(united_city(folder)).size() == 5);
    const Outcome made = generalised({"--scale", "1:25000", "-o", folder / "out.city.json"});
    CHECK(made.exit == 0);
    CHECK(made.says("h1: G421 is left out of a row of 5 buildings: 'h0' stands for it"));
    const json out = united_city(folder);
    CHECK(ids_in(out) == std::set<std::string>{"h0", "h2", "h4"});
    CHECK(out["CityObjects"]["h2"]["attributes"]["oriel_members"] == "h2;h3");
    CHECK(generalised({"--series", "1:5000,1:25000", "-o", folder / "s"}).exit == 0);
    CHECK(run({"generalise", "--check", "--from", folder / "s"}).exit == 0);
    const json coarse = json::parse(bytes_of(folder / "s.1-25000.city.json"));
    CHECK(coarse["CityObjects"]["h1"]["attributes"]["oriel_member_of"] == "h0");
    CHECK(coarse["CityObjects"]["h4"]["geometry"].size() == 1);
    CHECK(bytes_of(folder / "s.oplog.jsonl").find("\"operation\":\"typify\"") != std::string::npos);
  }

  TEST_CASE("a gap that a road runs through stays open") {
    const json pair = boxes({{"a"}, {"b", 11.9}});
    const std::string line = R"({"type": "LineString", "coordinates": [[11, -50], [11, 50]]})";
    const std::string aside = R"({"type": "LineString", "coordinates": [[-3, -50], [-3, 50]]})";
    const Folder folder;
    for (const std::string& geometry : {kAlley, line}) {
      const Outcome made = united(folder, pair, {"--keep-free", roads(folder, geometry)});
      CHECK(made.exit == 0);
      CHECK(made.says("a: G440 stays apart from 'b'"));
      CHECK(ids_in(united_city(folder)).size() == 2);
    }
    CHECK(united(folder, pair, {"--keep-free", roads(folder, aside)}).exit == 0);
    CHECK(ids_in(united_city(folder)).size() == 1);
    // So wide that it reaches under a house.
    const Outcome wide = united(folder, boxes({{"a"}, {"b", 10}}),
                                {"--keep-free", roads(folder, aside, R"({"width": 7})")});
    CHECK(wide.exit == 0);
    CHECK(wide.says("a: E191 covers 5.00 m2"));
    CHECK(wide.says("a: G440 and 1 other"));
    CHECK(ids_in(united_city(folder)).size() == 2);
  }

  TEST_CASE("roads of a CityJSON file are kept free, too") {
    const Folder folder;
    json city = boxes({{"road", 10.5, -5, 0.5, 20, 0.01}, {"tree", -3, -3, 1, 1, 5}});
    city["CityObjects"]["road"]["type"] = "Road";
    city["CityObjects"]["tree"]["type"] = "SolitaryVegetationObject";
    const Outcome made = united(folder, boxes({{"a"}, {"b", 11.9}}),
                                {"--keep-free", folder.write("roads.city.json", city.dump())});
    CHECK(made.says("G440 stays apart"));
    CHECK(ids_in(united_city(folder)).size() == 2);
    city["CityObjects"].erase("road");
    CHECK(
        united(folder, boxes({{"a"}}), {"--keep-free", folder.write("none.city.json", city.dump())})
            .says("E190 has no area"));
  }

  TEST_CASE("a court with ground that is kept free is not closed") {
    std::vector<Place> ring;
    const std::vector<double> from{0, 3, 4.5}, size{3, 1.5, 3};
    for (std::size_t x = 0; x < 3; ++x)
      for (std::size_t y = 0; y < 3; ++y)
        if (x != 1 || y != 1)
          ring.push_back(
              {"h" + std::to_string(x) + std::to_string(y), from[x], from[y], size[x], size[y], 6});
    const Folder folder;
    CHECK(united(folder, boxes(ring)).exit == 0);
    CHECK(surface_types(united_city(folder), "h00")["WallSurface"] == 4);
    const std::string well =
        R"({"type": "Polygon", "coordinates": [[[3.5,3.5],[4,3.5],[4,4],[3.5,4],[3.5,3.5]]]})";
    CHECK(united(folder, boxes(ring), {"--keep-free", roads(folder, well)}).exit == 0);
    CHECK(surface_types(united_city(folder), "h00")["WallSurface"] == 8);
  }

  TEST_CASE("ground to be kept free that cannot be read ends the run") {
    const Folder folder;
    const json pair = boxes({{"a"}, {"b", 11.9}});
    const auto refusal = [&](const std::string& file) {
      const Outcome made = united(folder, pair, {"--keep-free", file});
      CHECK(made.exit == 5);
      CHECK(!std::ranges::count(folder.names(), "out.city.json"));
      return made;
    };
    CHECK(refusal(folder / "none.geojson").says("E101"));
    CHECK(refusal(folder.write("text.geojson", "roads")).says("E10"));
    CHECK(refusal(folder.write("list.geojson", "[1]")).says("E190"));
    CHECK(refusal(folder.write("empty.geojson", R"({"type": "FeatureCollection", "features": []})"))
              .says("E190 has no area"));
    for (const std::string geometry :
         {R"({"type": "Polygon", "coordinates": [[[0,0],[1,1],[0,0]]]})",
          R"({"type": "Polygon", "coordinates": [[[0,0],[1,null],[1,1],[0,0]]]})",
          R"({"type": "LineString", "coordinates": [[0,0]]})",
          R"({"type": "Curve", "coordinates": []})"})
      CHECK(refusal(roads(folder, geometry)).says("feature 1"));
    CHECK(refusal(roads(folder, kAlley, R"({"width": -1})")).says("'width'"));
    const Outcome elsewhere =
        united(folder, boxes({{"a", 85000, 446000}}), {"--keep-free", roads(folder, kAlley)});
    CHECK(elsewhere.exit == 5);
    CHECK(elsewhere.says("E192 lies elsewhere"));
  }

  TEST_CASE("ground to be kept free without groups has no effect and says so") {
    const Folder folder;
    const Outcome made =
        run({"generalise", folder.write("in.city.json", boxes({{"a"}}).dump()), "--scale",
             "1:10000", "--keep-free", roads(folder, kAlley), "-o", folder / "out.city.json"});
    CHECK(made.exit == 0);
    CHECK(made.says("R279"));
  }

  TEST_CASE("a series keeps ground free at all its scales") {
    const Folder folder;
    const Outcome made =
        run({"generalise",
             folder.write("in.city.json", boxes({{"a"}, {"b", 11.9}, {"c", 21.9}}).dump()),
             "--neighbours", "--series", "1:1000,1:10000", "--profile", town_profile(folder),
             "--keep-free", roads(folder, kAlley), "-o", folder / "s"});
    CHECK(made.exit == 0);
    const json out = json::parse(bytes_of(folder / "s.1-10000.city.json"));
    CHECK(out["CityObjects"]["b"]["attributes"]["oriel_members"] == "b;c");
    CHECK(!out["CityObjects"]["a"]["attributes"].contains("oriel_members"));
  }

  TEST_CASE("contacts that are centimetres off, overlaps and other systems leave whole solids") {
    const Folder folder;
    // c overlaps b, in stands in a, d is 7 cm off, e is higher.
    const json city = boxes({{"a"},
                             {"b", 10.04},
                             {"c", 19},
                             {"in", 2, 2, 3, 3, 3},
                             {"d", 29.12},
                             {"e", 0, 10, 10, 10, 20}});
    const Outcome made = united(folder, city);
    CHECK(made.exit == 0);
    for (const std::string said : {"E175", "in: E176", "E178", "e: G423"})
      CHECK_MESSAGE(made.says(said), said);
    CHECK(run({"validate", folder / "out.city.json"}).exit == 0);
    json other = boxes({{"x", 40}});
    other["metadata"] = {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}};
    const Outcome mixed =
        united(folder, city, {"--neighbours=" + folder.write("other.city.json", other.dump())});
    CHECK(mixed.exit == 0);
    CHECK(mixed.says("x: E177"));
  }
}
