#pragma once

#include "tests/studio/session/building_of_bytes.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::test {

/// A value of the pool in a page that view has written (docs/formats.md).
inline nlohmann::json value_of(const nlohmann::json& pool, std::size_t number) {
  const nlohmann::json& entry = pool["values"].at(number);
  if (!entry.is_array()) return entry;
  const int keys = entry.at(0);
  if (keys == -2) {
    std::string text;
    for (std::size_t i = 1; i < entry.size(); ++i)
      text += (i > 1 ? "\n" : "") + value_of(pool, entry[i]).get<std::string>();
    return text;
  }
  nlohmann::json value = keys < 0 ? nlohmann::json::array() : nlohmann::json::object();
  for (std::size_t i = 1; i < entry.size(); ++i) {
    nlohmann::json part = value_of(pool, entry[i]);
    if (keys < 0)
      value.push_back(std::move(part));
    else
      value[pool["keys"].at(static_cast<std::size_t>(keys)).at(i - 1).get<std::string>()] =
          std::move(part);
  }
  return value;
}

/// The replies in a text that a Recording has given.
inline nlohmann::json replies_of(const std::string& text) {
  const auto pool = nlohmann::json::parse(text);
  return value_of(pool, pool["root"]);
}

/// A polygon of a recorded building.
struct RecordedPolygon {
  /// Vertices of its rings.
  std::vector<std::vector<std::size_t>> rings;
  std::vector<std::size_t> owners;
};

/// The geometry of a recorded building.
struct RecordedShape {
  /// Three for each vertex.
  std::vector<double> vertices_mm;
  std::vector<RecordedPolygon> polygons;
  std::vector<double> storeys_mm;
};

inline RecordedShape shape_of(const std::string& base64) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char digit : base64.substr(0, base64.find('='))) {
    bits = (bits << 6) | static_cast<std::uint32_t>(kDigits.find(digit));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count));
  }
  const auto all = read_bytes(bytes);
  REQUIRE(all.size() == 1);
  const BuildingOfBytes& flat = all[0];
  RecordedShape shape;
  shape.storeys_mm = flat.head["storeys_mm"].get<std::vector<double>>();
  for (std::size_t i = 0; i < flat.vertices.size(); ++i)
    shape.vertices_mm.push_back(flat.head["base_mm"][i % 3].get<double>() + flat.vertices[i]);
  std::size_t ring = 0, corner = 0, owner = 0;
  for (std::size_t i = 0; i < flat.ring_ends.size(); ++i) {
    RecordedPolygon& polygon = shape.polygons.emplace_back();
    for (; ring < flat.ring_ends[i]; ++ring) {
      polygon.rings.emplace_back();
      for (; corner < flat.corner_ends[ring]; ++corner)
        polygon.rings.back().push_back(flat.corners[corner]);
    }
    for (; owner < flat.owner_ends[i]; ++owner) polygon.owners.push_back(flat.owners[owner]);
  }
  return shape;
}

}  // namespace oriel::test
