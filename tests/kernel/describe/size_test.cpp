#include "tests/support/changed.h"
#include "tests/support/described.h"
#include "tests/support/houses.h"

#include <numbers>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::check_numbers;
using test::described;
using test::Described;

BoxBody house() { return BoxBody().add({0, 0, 0}, {10, 8, 6}); }

TEST_SUITE("kernel/describe") {
  TEST_CASE("a window in a wall has its size and its place") {
    const Described d = described(house().remove({2, 0, 1}, {4, 0.2, 2.5}).build());
    const FeatureId window = d.at({2, 0, 1}, {4, 0.2, 2.5});
    check_numbers(d, window,
                  {{"natural", 1},
                   {"quality", 3.0 / 57},
                   {"value", 3.0 / 60},
                   {"new_area", 3},
                   {"old_area", 57},
                   {"volume", 0.6},
                   {"surface", 4.4},
                   {"split_order", 1},
                   {"a", 2},
                   {"b", 1.5},
                   {"c", 0.2},
                   {"silhouette", 3},
                   {"width", 2},
                   {"height", 1.5},
                   {"depth", 0.2},
                   {"inclination", 90},
                   {"azimuth", 180},
                   {"growth_up", 0},
                   {"growth_down", 0},
                   {"growth_out", 0},
                   {"growth_side", 0},
                   {"base_height", 1},
                   {"top", 2.5},
                   {"below_ridge", 3.5},
                   {"above_eaves", -5},
                   {"edge_gap", 1},
                   {"host_inclination", 90},
                   {"storey", 0},
                   {"per_facade", 1},
                   {"per_storey", 1}});
    CHECK(d.table().text(window, Attribute::sense) == "hole");
    CHECK(d.table().text(window, Attribute::ground_source) == "facet");
  }

  TEST_CASE("a chimney on a flat roof has its size and its place") {
    const Described d = described(house().add({4, 3, 6}, {4.6, 3.5, 7.5}).build());
    const FeatureId chimney = d.at({4, 3, 6}, {4.6, 3.5, 7.5});
    check_numbers(d, chimney,
                  {{"new_area", 0.3},
                   {"old_area", 79.7},
                   {"volume", 0.45},
                   {"surface", 3.6},
                   {"split_order", 1},
                   {"a", 1.5},
                   {"b", 0.6},
                   {"c", 0.5},
                   {"silhouette", 0.9},
                   {"width", 0.6},
                   {"height", 1.5},
                   {"depth", 1.5},
                   {"inclination", 0},
                   {"growth_up", 1.5},
                   {"growth_down", 0},
                   {"growth_out", 1.5},
                   {"growth_side", 0},
                   {"base_height", 6},
                   {"top", 7.5},
                   {"below_ridge", -1.5},
                   {"above_eaves", 0},
                   {"edge_gap", 3},
                   {"host_inclination", 0},
                   {"per_facade", 1}});
    CHECK(d.table().text(chimney, Attribute::sense) == "protrusion");
    CHECK_FALSE(d.has(chimney, "azimuth"));
    CHECK_FALSE(d.has(chimney, "storey"));
    CHECK_FALSE(d.has(chimney, "per_storey"));
  }

  TEST_CASE("growth tells in which direction a part leaves the box of its host") {
    const Described d = described(house()
                                      .add({3, -1.5, 3}, {7, 0, 3.2})
                                      .add({9, -1, 4}, {11, 0, 4.5})
                                      .add({10, 2, -2}, {12, 4, 3})
                                      .build());
    const FeatureId balcony = d.at({3, -1.5, 3}, {7, 0, 3.2});
    check_numbers(d, balcony,
                  {{"growth_out", 1.5},
                   {"growth_up", 0},
                   {"growth_down", 0},
                   {"growth_side", 0},
                   {"depth", 1.5},
                   {"width", 4}});
    check_numbers(d, d.at({9, -1, 4}, {11, 0, 4.5}), {{"growth_out", 1}, {"growth_side", 1}});
    check_numbers(d, d.at({10, 2, -2}, {12, 4, 3}),
                  {{"growth_out", 2}, {"growth_down", 2}, {"growth_side", 0}, {"azimuth", 90}});
  }

  TEST_CASE("azimuths count clockwise from north") {
    const Described d = described(house()
                                      .remove({2, 0, 1}, {4, 0.2, 2.5})
                                      .remove({2, 7.8, 1}, {4, 8, 2.5})
                                      .remove({0, 2, 1}, {0.2, 4, 2.5})
                                      .remove({9.8, 2, 1}, {10, 4, 2.5})
                                      .build());
    check_numbers(d, d.at({2, 7.8, 1}, {4, 8, 2.5}), {{"azimuth", 0}});
    check_numbers(d, d.at({9.8, 2, 1}, {10, 4, 2.5}), {{"azimuth", 90}});
    check_numbers(d, d.at({2, 0, 1}, {4, 0.2, 2.5}), {{"azimuth", 180}});
    check_numbers(d, d.at({0, 2, 1}, {0.2, 4, 2.5}), {{"azimuth", 270}});
  }

  TEST_CASE("features have the level of detail that the input states") {
    Building building = test::full_house();
    const auto first = [](const Described& d) {
      return d.table().number(FeatureId{0}, Attribute::lod);
    };
    for (const auto& [text, number] : {std::pair{"2.2", 2.2}, {"3", 3.0}}) {
      building.lod = text;
      CHECK(first(described(building)) == number);
    }
    for (const char* text : {"", "LoD2", "2.2b"}) {
      CAPTURE(std::string(text));
      building.lod = text;
      CHECK_FALSE(first(described(building)));
    }
  }

  TEST_CASE("a turned house has features of the same sizes that face elsewhere") {
    const Building building = test::full_house();
    const Described d = described(building);
    for (const double degrees : {30.0, 90.0, 217.0}) {
      CAPTURE(degrees);
      const Described t = described(test::mapped(building, [&](Vec3 p) {
        return test::turned(p, {0, 0, 1}, degrees * std::numbers::pi / 180);
      }));
      REQUIRE(t.table().rows() == d.table().rows());
      for (const char* name : {"a", "b", "c", "width", "height", "depth", "inclination",
                               "base_height", "top", "below_ridge", "above_eaves", "edge_gap",
                               "storey", "per_facade", "per_storey", "growth_out", "growth_up"}) {
        CAPTURE(std::string(name));
        const auto numbers_in = [&](const FeatureTable& table) {
          const auto numbers = table.numbers(find_attribute(name).value());
          return std::vector<double>(numbers.begin(), numbers.end());
        };
        std::vector<double> before = numbers_in(d.table());
        std::vector<double> after = numbers_in(t.table());
        for (auto* values : {&before, &after}) {
          for (double& v : *values) v = std::isnan(v) ? -1e6 : v;
          std::ranges::sort(*values);
        }
        for (std::size_t i = 0; i < before.size(); ++i)
          CHECK(std::abs(before[i] - after[i]) < 1e-4);
      }
      std::vector<double> facing, faced;
      for (const FeatureId id : test::all_features(d.segmented.segmentation)) {
        if (const auto a = d.table().number(id, Attribute::azimuth))
          facing.push_back(std::fmod(*a - degrees + 720 + 1e-3, 360));
        if (const auto a = t.table().number(id, Attribute::azimuth))
          faced.push_back(std::fmod(*a + 1e-3, 360));
      }
      std::ranges::sort(facing);
      std::ranges::sort(faced);
      REQUIRE(facing.size() == faced.size());
      for (std::size_t i = 0; i < facing.size(); ++i) CHECK(std::abs(facing[i] - faced[i]) < 1e-3);
    }
  }

  TEST_CASE("the box of a slanted part stands on the ground and not on the part") {
    // A beam up the gable's slope: its box is level though the beam is not.
    const Described d = described(test::ConvexBody()
                                      .add(test::gable())
                                      .add({{{-1, 0, 0}, -5},
                                            {{1, 0, 0}, 5.4},
                                            {{0, -1, 0}, -1},
                                            {{0, 1, 0}, 3},
                                            {{0, 3, -4}, -24},
                                            {{0, -3, 4}, 25.2}})
                                      .build());
    REQUIRE(d.table().rows() == 1);
    check_numbers(d, FeatureId{0},
                  {{"a", 2},
                   {"b", 1.8},
                   {"c", 0.4},
                   {"depth", 0.24},
                   {"width", 0.4},
                   {"inclination", std::atan2(3, 4) * 180 / std::numbers::pi},
                   {"azimuth", 180}});
  }
}

}  // namespace
}  // namespace oriel
