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

/// The same with the first ring of each cube beginning with a vertex twice: E312.
inline nlohmann::ordered_json doubled_cubes(const std::vector<std::string>& ids) {
  nlohmann::ordered_json city = cubes(ids);
  for (const std::string& id : ids) {
    auto& ring = city["CityObjects"][id]["geometry"][0]["boundaries"][0][0][0];
    ring.insert(ring.begin(), ring[0]);
  }
  return city;
}

/// What `make` gives as a CityJSONSeq: a header, then a line for each cube.
template <class Cubes>
std::string cube_lines_of(Cubes make, const std::vector<std::string>& ids) {
  nlohmann::ordered_json header = make(std::vector<std::string>{});
  std::string text = header.dump() + "\n";
  for (const std::string& id : ids) {
    nlohmann::ordered_json feature = make(std::vector<std::string>{id});
    feature["type"] = "CityJSONFeature";
    feature["id"] = id;
    feature.erase("version");
    feature.erase("transform");
    text += feature.dump() + "\n";
  }
  return text;
}

inline std::string cube_lines(const std::vector<std::string>& ids) {
  return cube_lines_of(cubes, ids);
}

inline std::string doubled_cube_lines(const std::vector<std::string>& ids) {
  return cube_lines_of(doubled_cubes, ids);
}

/// A cube of 4 m and on it, as an installation of its own, a shaft of 0.5 × 0.5 × 1 m from the
/// height `base_mm`: its four sides and its top, with its bottom if `is_closed`.
inline nlohmann::ordered_json cube_with_shaft(int base_mm = 4000, bool is_closed = false) {
  using nlohmann::ordered_json;
  ordered_json city = cubes({"house"});
  const int first = static_cast<int>(city["vertices"].size());
  for (int i = 0; i < 8; ++i)
    city["vertices"].push_back(
        {1000 + (i & 1) * 500, 1000 + (i >> 1 & 1) * 500, base_mm + (i >> 2) * 1000});
  ordered_json surfaces = ordered_json::array();
  std::vector<std::vector<int>> rings{
      {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  if (is_closed) rings.push_back({0, 2, 3, 1});
  for (const std::vector<int>& ring : rings) {
    ordered_json polygon = ordered_json::array();
    for (const int corner : ring) polygon.push_back(first + corner);
    surfaces.push_back(ordered_json::array({polygon}));
  }
  city["CityObjects"]["house"]["children"] = {"shaft"};
  city["CityObjects"]["shaft"] = {
      {"type", "BuildingInstallation"},
      {"parents", {"house"}},
      {"geometry",
       ordered_json::array({{{"type", "MultiSurface"}, {"lod", "3"}, {"boundaries", surfaces}}})}};
  return city;
}

}  // namespace oriel::test
