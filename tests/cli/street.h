#pragma once

#include "examples/generator/command.h"
#include "tests/cli/command.h"

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::test {

/// A box-shaped building.
struct Place {
  std::string id;
  double x = 0, y = 0;
  double width = 10, depth = 10, height = 6;
  double ridge = 0;  ///< of a gabled roof along x; 0: the roof is flat
};

/// A CityJSON file of boxes, in millimetres.
inline nlohmann::json boxes(const std::vector<Place>& places) {
  using nlohmann::json;
  json city = {{"type", "CityJSON"},
               {"version", "2.0"},
               {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0, 0, 0}}}},
               {"CityObjects", json::object()},
               {"vertices", json::array()}};
  for (const Place& p : places) {
    const auto first = static_cast<int>(city["vertices"].size());
    const auto add = [&](double x, double y, double z) {
      city["vertices"].push_back(
          {std::lround(1000 * x), std::lround(1000 * y), std::lround(1000 * z)});
    };
    for (const double z : {0.0, p.height}) {
      add(p.x, p.y, z);
      add(p.x + p.width, p.y, z);
      add(p.x + p.width, p.y + p.depth, z);
      add(p.x, p.y + p.depth, z);
    }
    using Rings = std::vector<std::vector<int>>;
    Rings rings{{3, 2, 1, 0}, {0, 1, 5, 4}, {2, 3, 7, 6}};
    Rings rest{{4, 5, 6, 7}, {1, 2, 6, 5}, {3, 0, 4, 7}};
    if (p.ridge > 0) {
      add(p.x, p.y + p.depth / 2, p.ridge);
      add(p.x + p.width, p.y + p.depth / 2, p.ridge);
      rest = {{1, 2, 6, 9, 5}, {3, 0, 4, 8, 7}, {4, 5, 9, 8}, {6, 7, 8, 9}};
    }
    rings.insert(rings.end(), rest.begin(), rest.end());
    json shell = json::array();
    for (const auto& ring : rings) {
      json points = json::array();
      for (const int v : ring) points.push_back(first + v);
      shell.push_back(json::array({points}));
    }
    json solid = {{"type", "Solid"}, {"lod", "2"}, {"boundaries", json::array({shell})}};
    city["CityObjects"][p.id] = {{"type", "Building"}, {"geometry", json::array({solid})}};
  }
  return city;
}

/// The path of a profile that makes one of what adjoins from 1:10000 on.
inline std::string town_profile(const Folder& folder, const std::string& more = "gap-mm: 0.2") {
  return folder.write("town.yaml",
                      "schema: oriel-profile/1\nprofile: {name: town, version: 1.0.0}\nlevels:\n"
                      "  map:\n    form: as-is\n    map-mm: 0.3\n    verdicts: {point: omit}\n"
                      "    buildings: {aggregate: touching, " +
                          more + "}\n");
}

inline std::set<std::string> ids_in(const nlohmann::json& city) {
  std::set<std::string> ids;
  for (const auto& [id, object] : city["CityObjects"].items()) ids.insert(id);
  return ids;
}

/// The path of a stream of generated houses in rows and blocks.
inline std::string town(const Folder& folder, int houses) {
  const std::string path = folder / "town.city.jsonl", count = std::to_string(houses);
  const std::array call{"oriel-generate", "--style", "city",     "--count",   count.c_str(),
                        "--seed",         "3",       "--output", path.c_str()};
  std::ostringstream out, err;
  REQUIRE(generator::run_command(static_cast<int>(call.size()), call.data(), out, err) == 0);
  return path;
}

}  // namespace oriel::test
