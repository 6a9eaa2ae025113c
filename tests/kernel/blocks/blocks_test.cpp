#include "kernel/blocks/blocks.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

Blocks blocks_of(const Building& building, const BlockOptions& options = {}) {
  Work work(kWorkBudget);
  auto made = blocks(solid_of(building), building.id, options, {}, work);
  REQUIRE(made.value);
  CHECK(is_closed(made.value->solid));
  for (const Plane& plane : made.value->solid.planes)
    CHECK((std::abs(plane.normal.z) == 1 || plane.normal.z == 0));
  return std::move(*made.value);
}

BlockOptions by_roof() {
  BlockOptions options;
  options.is_by_roof = true;
  return options;
}

Building turned(Building building, double angle) {
  for (Vec3& p : building.vertices)
    p = {p.x * std::cos(angle) - p.y * std::sin(angle) + 20,
         p.x * std::sin(angle) + p.y * std::cos(angle) + 20, p.z};
  return building;
}

}  // namespace

TEST_SUITE("kernel/blocks") {
  TEST_CASE("a gable becomes a block below whose top seven tenths of the roof lie") {
    const Blocks made = blocks_of(gabled_house());
    CHECK(made.parts == 1);
    CHECK(made.solid.facets.size() == 6);
    CHECK(volume_m3(made.solid) == doctest::Approx(12 * 8 * 8.1).epsilon(1e-6));
  }

  TEST_CASE("a simpler footprint is a closed solid with the heights of the blocks") {
    const Building body = BoxBody()
                              .add({0, 0, 0}, {20, 12, 6})
                              .add({8, -1, 0}, {10, 0, 6})
                              .add({20, 0, 0}, {21, 4, 6})
                              .build();
    CHECK(blocks_of(body).solid.facets.size() == 2 + 12 - 2);
    BlockOptions options;
    options.least_edge_m = 3;
    const Blocks made = blocks_of(body, options);
    CHECK(made.short_edges == 0);
    CHECK(made.solid.facets.size() == 6);
    CHECK(volume_m3(made.solid) == doctest::Approx(20 * 12 * 6));
    // With room around it the corner is not given up, but the oriel still goes.
    options.may_cover = [](const Box&) { return true; };
    CHECK(blocks_of(body, options).short_edges == 0);
  }

  TEST_CASE("a courtyard is simplified as the outer side is and stays a courtyard") {
    const Building body = BoxBody()
                              .add({0, 0, 0}, {30, 6, 6})
                              .add({0, 24, 0}, {30, 30, 6})
                              .add({0, 6, 0}, {6, 24, 6})
                              .add({24, 6, 0}, {30, 24, 6})
                              .add({14, 6, 0}, {16, 7, 6})
                              .build();
    BlockOptions options;
    options.least_edge_m = 3;
    const Blocks made = blocks_of(body, options);
    CHECK(made.solid.facets.size() == 10);
    CHECK(volume_m3(made.solid) == doctest::Approx((30 * 30 - 18 * 18) * 6));
  }

  TEST_CASE("of a noisy building no spike is left that is thinner than its planes are apart") {
    const Building body =
        BoxBody().add({0, 0, 0}, {10, 8, 6}).add({4, -1, 0}, {4.003, 0, 6}).build();
    CHECK(blocks_of(body).solid.facets.size() == 10);
    Tolerances noisy;
    noisy.plane_offset_m = 0.004;
    Work work(kWorkBudget);
    const auto made = blocks(solid_of(body), body.id, {}, noisy, work);
    REQUIRE(made.value);
    CHECK(made.value->solid.facets.size() == 6);
    CHECK(volume_m3(made.value->solid) == doctest::Approx(480).epsilon(1e-3));
  }

  TEST_CASE("a flat block stays as it is however it is turned") {
    for (int i = 0; i < 12; ++i) {
      const Building body =
          turned(BoxBody().add({0, 0, 0}, {10, 8, 6}).build(), i * std::numbers::pi / 7);
      const Blocks made = blocks_of(body);
      CHECK(made.solid.facets.size() == 6);
      CHECK(volume_m3(made.solid) == doctest::Approx(480).epsilon(1e-4));
    }
  }

  TEST_CASE("parts of the roof that are more than a storey apart are blocks of their own") {
    const Building tower = BoxBody().add({0, 0, 0}, {12, 8, 6}).add({0, 8, 0}, {4, 14, 10}).build();
    const Blocks made = blocks_of(tower, by_roof());
    CHECK(made.parts == 2);
    CHECK(volume_m3(made.solid) == doctest::Approx(12 * 8 * 6 + 4 * 6 * 10).epsilon(1e-9));
    CHECK(blocks_of(tower).parts == 1);
    const Building shed = BoxBody().add({0, 0, 0}, {12, 8, 6}).add({0, 8, 0}, {4, 14, 4}).build();
    CHECK(blocks_of(shed, by_roof()).parts == 1);
  }

  TEST_CASE("a tower in the middle of a roof and a light well are blocks") {
    const Building house = BoxBody()
                               .add({0, 0, 0}, {20, 10, 6})
                               .add({4, 4, 6}, {7, 7, 12})
                               .remove({12, 3, 2}, {16, 7, 6})
                               .build();
    const Blocks made = blocks_of(house, by_roof());
    CHECK(made.parts == 3);
    CHECK(volume_m3(made.solid) == doctest::Approx(volume_m3(solid_of(house))).epsilon(1e-9));
  }

  TEST_CASE("what is smaller than four square metres is no block") {
    const Building house = BoxBody().add({0, 0, 0}, {20, 10, 6}).add({4, 4, 6}, {5, 5, 12}).build();
    CHECK(blocks_of(house, by_roof()).parts == 1);
  }

  TEST_CASE("a courtyard stays open unless it is below the least piece") {
    const Building house =
        BoxBody().add({0, 0, 0}, {20, 10, 6}).remove({8, 3, 0}, {12, 7, 6}).build();
    CHECK(volume_m3(blocks_of(house).solid) == doctest::Approx(184 * 6).epsilon(1e-9));
    BlockOptions coarse;
    coarse.least_piece_m2 = 36;
    CHECK(volume_m3(blocks_of(house, coarse).solid) == doctest::Approx(200 * 6).epsilon(1e-9));
  }

  TEST_CASE("an overhang above the ground is no part of the footprint") {
    const Building house = BoxBody().add({0, 0, 0}, {10, 8, 6}).add({-2, 0, 4}, {0, 8, 6}).build();
    const Blocks made = blocks_of(house);
    CHECK_FALSE(made.is_from_above);
    CHECK(volume_m3(made.solid) == doctest::Approx(480).epsilon(1e-9));
  }

  TEST_CASE("a building on stilts has what is seen from above as its footprint") {
    const Building house = BoxBody().add({0, 0, 3}, {10, 8, 6}).add({0, 0, 0}, {2, 2, 3}).build();
    const Blocks made = blocks_of(house);
    CHECK(made.is_from_above);
    CHECK(volume_m3(made.solid) == doctest::Approx(480).epsilon(1e-9));
  }
}
