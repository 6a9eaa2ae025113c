#include "io/cityjson/cityjson_collector.h"

#include <cstdint>
#include <limits>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using nlohmann::json;

namespace {

std::string header_line(double scale) {
  return json{{"type", "CityJSON"},
              {"version", "2.0"},
              {"transform", {{"scale", {scale, scale, scale}}, {"translate", {0, 0, 0}}}},
              {"CityObjects", json::object()},
              {"vertices", json::array()}}
      .dump();
}

/// A feature of one triangle.
std::string triangle_line(const std::string& id, const json& ring, const json& vertices) {
  const json geometry = {{"type", "MultiSurface"}, {"lod", "2"}, {"boundaries", {{ring}}}};
  return json{
      {"type", "CityJSONFeature"},
      {"id", id},
      {"CityObjects", {{id, {{"type", "Building"}, {"geometry", json::array({geometry})}}}}},
      {"vertices", vertices}}
      .dump();
}

const json kCorners{{0, 0, 0}, {1000, 0, 0}, {0, 1000, 0}};

json ring_of(const json& file, const std::string& id) {
  return file["CityObjects"][id]["geometry"][0]["boundaries"][0][0];
}

}  // namespace

TEST_SUITE("io") {
  TEST_CASE("a vertex that is not there does not become one of the next feature") {
    constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t missing : {std::int64_t{3}, std::int64_t{4}, kNone - 3, kNone}) {
      CAPTURE(missing);
      CityJsonCollector collector;
      collector.add(header_line(0.001));
      collector.add(triangle_line("a", {0, 1, 2}, kCorners));
      collector.add(triangle_line("b", {0, 1, missing}, kCorners));
      collector.add(triangle_line("c", {0, 1, 2}, kCorners));
      const json file = json::parse(collector.text());
      CHECK(file["vertices"].size() == 9);
      CHECK(ring_of(file, "b") == json{3, 4, kNone});
      CHECK(ring_of(file, "c") == json{6, 7, 8});
    }
  }

  TEST_CASE("a scale finer than any number needs does not end the collecting") {
    for (const double scale : {1e-17, 1e-19, 1e-25, 1e-80, 1e-300}) {
      CAPTURE(scale);
      CityJsonCollector collector;
      collector.add(header_line(scale));
      collector.add(triangle_line("a", {0, 1, 2}, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
      CHECK(json::parse(collector.text())["vertices"].size() == 3);
    }
  }

  TEST_CASE("a coordinate that 64 bits do not hold stays beyond every building") {
    CityJsonCollector collector;
    collector.add(header_line(0.001));
    collector.add(triangle_line("a", {0, 1, 2}, {{1e300, -1e300, 0}, {1e3, 0, 0}, {0, 1e3, 0}}));
    const json vertices = json::parse(collector.text())["vertices"];
    CHECK(vertices[0][0].get<double>() > 1e18);
    CHECK(vertices[0][1].get<double>() < -1e18);
    CHECK(vertices[1] == json{1000, 0, 0});
  }
}
