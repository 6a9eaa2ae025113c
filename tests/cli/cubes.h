#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::test {

/// A CityJSON text of one cube of 4 m for each id, 10 m apart, in millimetres.
inline nlohmann::ordered_json cubes(const std::vector<std::string>& ids) {
  using nlohmann::ordered_json;
  ordered_json city = {{"type", "CityJSON"},
                       {"version", "2.0"},
                       {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0, 0, 0}}}},
                       {"CityObjects", ordered_json::object()},
                       {"vertices", ordered_json::array()}};
  for (const std::string& id : ids) {
    const int first = static_cast<int>(city["vertices"].size());
    const int x = first / 8 * 10000;
    for (int i = 0; i < 8; ++i)
      city["vertices"].push_back({x + (i & 1) * 4000, (i >> 1 & 1) * 4000, (i >> 2) * 4000});
    ordered_json shell = ordered_json::array();
    for (const std::vector<int>& ring : std::vector<std::vector<int>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
      ordered_json polygon = ordered_json::array();
      for (const int corner : ring) polygon.push_back(first + corner);
      shell.push_back(ordered_json::array({polygon}));
    }
    ordered_json boundaries = ordered_json::array({shell});
    city["CityObjects"][id] = {
        {"type", "Building"},
        {"geometry",
         ordered_json::array({{{"type", "Solid"}, {"lod", "3"}, {"boundaries", boundaries}}})}};
  }
  return city;
}

/// The same as a CityJSONSeq: a header, then a line for each cube.
inline std::string cube_lines(const std::vector<std::string>& ids) {
  nlohmann::ordered_json header = cubes({});
  std::string text = header.dump() + "\n";
  for (const std::string& id : ids) {
    nlohmann::ordered_json feature = cubes({id});
    feature["type"] = "CityJSONFeature";
    feature["id"] = id;
    feature.erase("version");
    feature.erase("transform");
    text += feature.dump() + "\n";
  }
  return text;
}

}  // namespace oriel::test
