#include "tests/support/described.h"
#include "tests/support/houses.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::box;
using test::BoxBody;
using test::check_numbers;
using test::ConvexBody;
using test::described;
using test::Described;

TEST_SUITE("kernel/describe") {
  TEST_CASE("a door on raised ground stands on its own ground") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {10, 8, 6})
                                      .add({11, 0, 2}, {20, 8, 8})
                                      .remove({4, 0, 0}, {5, 0.3, 2})
                                      .remove({14, 0, 2}, {15, 0.3, 4})
                                      .remove({17, 0, 3}, {18, 0.3, 4})
                                      .build());
    for (const FeatureId door : {d.at({4, 0, 0}, {5, 0.3, 2}), d.at({14, 0, 2}, {15, 0.3, 4})}) {
      check_numbers(d, door, {{"base_height", 0}, {"top", 2}});
      CHECK(d.table().text(door, Attribute::ground_source) == "facet");
    }
    check_numbers(d, d.at({17, 0, 3}, {18, 0.3, 4}), {{"base_height", 1}});
  }

  TEST_CASE("in a house on two levels of ground every door stands on its own") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {10, 8, 6})
                                      .add({10, 0, 2}, {20, 8, 8})
                                      .remove({4, 0, 0}, {5, 0.3, 2})
                                      .remove({14, 0, 2}, {15, 0.3, 4})
                                      .build());
    check_numbers(d, d.at({4, 0, 0}, {5, 0.3, 2}), {{"base_height", 0}});
    check_numbers(d, d.at({14, 0, 2}, {15, 0.3, 4}), {{"base_height", 0}});
  }

  TEST_CASE("on a slope the ground is the one below the feature") {
    ConvexBody body;
    body.add({{{-1, 0, 0}, 0},
              {{1, 0, 0}, 20},
              {{0, -1, 0}, 0},
              {{0, 1, 0}, 8},
              {{0.1, 0, -1}, 0},
              {{0, 0, 1}, 10}});
    for (const double x : {4.0, 14.0}) body.remove(box({x, 0, 4}, {x + 1, 0.3, 6}));
    const Described d = described(body.build());
    for (const double x : {4.0, 14.0}) {
      const FeatureId window = d.at({x, 0, 4}, {x + 1, 0.3, 6});
      check_numbers(d, window, {{"base_height", 4 - 0.1 * (x + 0.5)}});
      CHECK(d.table().text(window, Attribute::ground_source) == "facet");
    }
  }

  TEST_CASE("without ground beneath the foot of the wall counts and then the lowest point") {
    // A keel: its two lower faces are too steep for ground.
    const Described d = described(ConvexBody()
                                      .add({{{0, -1, 0}, 0},
                                            {{0, 1, 0}, 8},
                                            {{0, 0, 1}, 24},
                                            {{12, 0, -1}, 60},
                                            {{-12, 0, -1}, -60}})
                                      .remove(box({4.8, 3, 23}, {5.2, 4, 24}))
                                      .remove(box({4.5, 2, 20}, {5.5, 4, 22}))
                                      .build());
    const FeatureId skylight = d.at({4.8, 3, 23}, {5.2, 4, 24});
    CHECK(d.table().text(skylight, Attribute::ground_source) == "wall");
    check_numbers(d, skylight, {{"base_height", -1}, {"top", 0}});
    const FeatureId cavity = d.at({4.5, 2, 20}, {5.5, 4, 22});
    CHECK(d.table().text(cavity, Attribute::ground_source) == "body");
    check_numbers(d, cavity, {{"base_height", 20}, {"top", 22}});
  }

  TEST_CASE("a window of a bay in the air stands over the ground and not over the bay") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {10, 8, 6})
                                      .add({3, -1, 3}, {7, 0, 5})
                                      .remove({4, -1, 3.5}, {6, -0.8, 4.5})
                                      .build());
    check_numbers(d, d.at({4, -1, 3.5}, {6, -0.8, 4.5}), {{"base_height", 3.5}, {"top", 4.5}});
    check_numbers(d, d.at({3, -1, 3}, {7, 0, 5}), {{"base_height", 3}});
  }

  TEST_CASE("eaves and ridge are those of the roof") {
    const Described d = described(test::full_house());
    const FeatureId chimney = d.at({3, 2, 7.5}, {3.4, 2.36, 10});
    check_numbers(d, chimney, {{"below_ridge", -1}, {"above_eaves", 1.5}, {"base_height", 7.5}});
    CHECK(d.number(chimney, "host_inclination") == doctest::Approx(36.8699).epsilon(1e-5));
    const FeatureId window = d.at({1, 0, 4}, {2.2, 0.2, 5.5});
    check_numbers(d, window, {{"below_ridge", 3.5}, {"above_eaves", -2}, {"edge_gap", 0.5}});
  }

  TEST_CASE("in a sunk terrace the host of a chimney is the floor") {
    for (const Building& building : {test::terrace_with_chimney(), test::terrace_with_block()}) {
      const Described d = described(building);
      REQUIRE(d.table().rows() == 2);
      for (const FeatureId id : test::all_features(d.segmented.segmentation))
        check_numbers(d, id, {{"host_inclination", 0}, {"inclination", 0}});
      const auto stands = test::features_of(d.segmented.segmentation, Sense::protrusion).at(0);
      check_numbers(d, stands, {{"base_height", 4}});
    }
  }

  TEST_CASE("storeys are counted from the lowest openings over all walls") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {10, 8, 9})
                                      .remove({1, 0, 1}, {2, 0.2, 2.5})
                                      .remove({4, 0, 0.8}, {5, 0.2, 2.5})
                                      .remove({1, 0, 4}, {2, 0.2, 5.5})
                                      .remove({9.8, 2, 4.1}, {10, 3, 5.4})
                                      .remove({9.8, 2, 7}, {10, 3, 8})
                                      .add({4, 4, 9}, {5, 5, 10})
                                      .build());
    check_numbers(d, d.at({1, 0, 1}, {2, 0.2, 2.5}),
                  {{"storey", 0}, {"per_storey", 2}, {"per_facade", 3}});
    check_numbers(d, d.at({4, 0, 0.8}, {5, 0.2, 2.5}), {{"storey", 0}, {"per_facade", 3}});
    check_numbers(d, d.at({1, 0, 4}, {2, 0.2, 5.5}), {{"storey", 1}, {"per_storey", 2}});
    check_numbers(d, d.at({9.8, 2, 4.1}, {10, 3, 5.4}), {{"storey", 1}, {"per_facade", 2}});
    check_numbers(d, d.at({9.8, 2, 7}, {10, 3, 8}), {{"storey", 2}, {"per_storey", 1}});
    CHECK_FALSE(d.has(d.at({4, 4, 9}, {5, 5, 10}), "storey"));
  }

  TEST_CASE("stairs before a plinth are on the facade of the wall and its door") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0}, {24, 8, 6})
                                      .add({8, -0.1, 0}, {24, 0, 0.6})
                                      .add({14, -1.1, 0}, {17, -0.1, 0.4})
                                      .remove({15, 0, 0.6}, {16, 0.2, 2.6})
                                      .build());
    const FeatureId door = d.at({15, 0, 0.6}, {16, 0.2, 2.6}),
                    stairs = d.at({14, -1.1, 0}, {17, -0.1, 0.4}),
                    plinth = d.at({8, -0.1, 0}, {24, 0, 0.6});
    for (const FeatureId id : {door, stairs, plinth})
      check_numbers(d, id, {{"along", id == plinth ? 16.0 : 15.5}});
    CHECK(holds(d, "same_facade", stairs, door));
    CHECK(holds(d, "same_facade", stairs, plinth));
  }

  TEST_CASE(
      "stairs before a plinth that lies under the whole house are on the facade of the wall") {
    const Described d = described(BoxBody()
                                      .add({0, 0, 0.4}, {24, 8, 6})
                                      .add({-0.05, -0.05, 0}, {24.05, 8.05, 0.4})
                                      .add({14, -1.1, 0}, {17, -0.05, 0.6})
                                      .add({14, -0.05, 0.4}, {17, 0, 0.6})
                                      .remove({15, 0, 0.6}, {16, 0.2, 2.6})
                                      .build());
    const FeatureId door = d.at({15, 0, 0.6}, {16, 0.2, 2.6}),
                    stairs = d.at({14, -1.1, 0}, {17, 0, 0.6});
    CHECK(holds(d, "same_facade", stairs, door));
    check_numbers(d, stairs, {{"along", 15.5}});
    check_numbers(d, door, {{"along", 15.5}});
  }

  TEST_CASE("what a cavity cannot have is missing and not zero") {
    const Described d = described(test::cavity_and_lumps());
    REQUIRE(d.table().rows() == 1);
    const FeatureId cavity{0};
    CHECK(d.table().text(cavity, Attribute::sense) == "cavity");
    for (const char* name : {"depth", "inclination", "azimuth", "growth_up", "growth_down",
                             "growth_out", "growth_side", "above_eaves", "edge_gap", "along",
                             "host_inclination", "storey", "per_facade", "per_storey"}) {
      CAPTURE(std::string(name));
      CHECK_FALSE(d.has(cavity, name));
    }
    check_numbers(d, cavity,
                  {{"value", 0},
                   {"quality", 0},
                   {"split_order", 0},
                   {"volume", 64},
                   {"surface", 96},
                   {"a", 4},
                   {"base_height", 1}});
  }

  TEST_CASE("places along a facade count from its left end as seen from outside") {
    const auto with_window = [](Vec3 low, Vec3 high) {
      BoxBody body;
      body.add({10, 20, 0}, {20, 28, 8});
      body.remove(low, high);
      return described(body.build());
    };
    check_numbers(with_window({11, 20, 1}, {12, 20.2, 2}), FeatureId{0}, {{"along", 1.5}});
    check_numbers(with_window({11, 27.8, 1}, {12, 28, 2}), FeatureId{0}, {{"along", 8.5}});
    check_numbers(with_window({10, 21, 1}, {10.2, 23, 2}), FeatureId{0}, {{"along", 6}});
    CHECK_FALSE(with_window({11, 21, 7.8}, {12, 22, 8}).has(FeatureId{0}, "along"));
  }

  TEST_CASE("a flush edge has a gap of zero") {
    const Described d = described(test::house_with_door());
    check_numbers(d, FeatureId{0}, {{"edge_gap", 0}, {"base_height", 0}, {"split_order", 2}});
  }
}

}  // namespace
}  // namespace oriel
