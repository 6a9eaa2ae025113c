#include "io/cityjson/material_colours.h"

#include "tests/io/files.h"

#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using nlohmann::json;

/// Two squares as one MultiSurface, and what `change` makes of the file.
template <class Change>
std::vector<std::optional<FaceColour>> colours_of(const Change& change) {
  json city = json::parse(R"({"type": "CityJSON", "version": "2.0",
    "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},
    "CityObjects": {"a": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2",
      "boundaries": [[[0, 1, 2, 3]], [[4, 5, 6, 7]]]}]}},
    "vertices": [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,5], [1,0,5], [1,1,5], [0,1,5]],
    "appearance": {"materials": [
      {"name": "roof", "diffuseColor": [1, 0.2, 0], "transparency": 0.25},
      {"name": "bare"}, {"name": "odd", "diffuseColor": "red"}]}})");
  change(city, city["CityObjects"]["a"]["geometry"][0]);
  const auto read = test::read_text(city.dump());
  REQUIRE(read.value);
  return material_colours(*read.value).at(0);
}

TEST_SUITE("io") {
  TEST_CASE("polygons have the colours of their materials") {
    const FaceColour roof{255, 51, 0, 191};
    using Colours = std::vector<std::optional<FaceColour>>;
    const auto values = [](const json& of) {
      return [of](json&, json& geometry) { geometry["material"]["visual"]["values"] = of; };
    };
    CHECK(colours_of(values({0, nullptr})) == Colours{roof, std::nullopt});
    CHECK(colours_of(values({1, 0})) == Colours{std::nullopt, roof});
    CHECK(colours_of([](json&, json& geometry) { geometry["material"]["visual"]["value"] = 0; }) ==
          Colours{roof, roof});
    // What does not fit gives none.
    CHECK(colours_of(values({9, -1})) == Colours(2));
    CHECK(colours_of(values({2})) == Colours(2));
    CHECK(colours_of(values("roof")) == Colours(2));
    CHECK(colours_of([](json&, json&) {}) == Colours(2));
    CHECK(colours_of([](json& city, json&) { city.erase("appearance"); }).empty());
  }

  TEST_CASE("of several themes the default is taken, else the first") {
    const auto both = [](json&, json& geometry) {
      geometry["material"]["a"]["values"] = {0, nullptr};
      geometry["material"]["b"]["values"] = {nullptr, 0};
    };
    CHECK(colours_of(both)[0]);
    const auto colours = colours_of([&](json& city, json& geometry) {
      both(city, geometry);
      city["appearance"]["default-theme-material"] = "b";
    });
    CHECK_FALSE(colours[0]);
    CHECK(colours[1]);
  }
}

}  // namespace
}  // namespace oriel
