#include "kernel/attach/raise_across.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// The pieces of cross_gable(): ridges at z = 9 along y = 4 and, to the north, along x = 6.
ConvexBody two_gables() {
  ConvexBody body;
  body.add(gable());
  return body.add({{{-1, 0, 0}, -3},
                   {{1, 0, 0}, 9},
                   {{0, -1, 0}, -4},
                   {{0, 1, 0}, 14},
                   {{0, 0, -1}, 0},
                   {{-1, 0, 1}, 3},
                   {{1, 0, 1}, 15}});
}

Plane plane(const Solid& solid, Vec3 normal, Vec3 point) {
  return plane_through(solid, normal, point, 0.5);
}

BlockAcross chimney(const Solid& solid, Vec3 min, Vec3 max) {
  return {{plane(solid, {-1, 0, 0}, min), plane(solid, {0, -1, 0}, min),
           plane(solid, {1, 0, 0}, max), plane(solid, {0, 1, 0}, max)},
          plane(solid, {0, 0, 1}, max)};
}

/// The block was put on as if the body had been built with it.
void check_same(const Attached& made, const ConvexBody& reference) {
  REQUIRE_MESSAGE(made.solid, made.reason);
  CHECK(is_closed(*made.solid));
  const Solid expected = solid_of(reference.build());
  CHECK(volume_m3(*made.solid) == doctest::Approx(volume_m3(expected)).epsilon(1e-6));
  CHECK(surface_m2(*made.solid) == doctest::Approx(surface_m2(expected)).epsilon(1e-6));
  CHECK(made.solid->facets.size() == expected.facets.size());
}

}  // namespace

TEST_SUITE("kernel/attach") {
  TEST_CASE("a chimney stands across a ridge, in a valley and on the apex of two ridges") {
    const Solid solid = solid_of(two_gables().build());
    const std::vector<std::pair<Vec3, Vec3>> blocks{
        {{1, 3.5, 5}, {2, 4.6, 10}},      // main ridge
        {{5.4, 9, 5}, {6.7, 10, 10}},     // the other ridge
        {{4, 5.5, 5}, {5, 6.5, 10}},      // valley
        {{5.5, 3.4, 5}, {6.6, 4.7, 10}},  // where the ridges meet
    };
    for (const auto& [min, max] : blocks) {
      CAPTURE(min.x);
      check_same(raise_across(solid, chimney(solid, min, max), 0.1),
                 two_gables().add(box(min, max)));
    }
  }

  TEST_CASE("a dormer box runs back into a roof with a valley") {
    const Solid solid = solid_of(two_gables().build());
    const BlockAcross dormer{
        {plane(solid, {0, 1, 0}, {0, 8, 0}), plane(solid, {-1, 0, 0}, {4, 0, 0}),
         plane(solid, {0, -1, 0}, {0, 5.6, 0}), plane(solid, {0, 0, 1}, {0, 0, 8})},
        {}};
    check_same(raise_across(solid, dormer, 0.1), two_gables().add(box({4, 5.6, 5}, {5.5, 8, 8})));
  }

  TEST_CASE("a block that stays on one facet, is too low or reaches over the eaves is refused") {
    const Solid solid = solid_of(two_gables().build());
    const auto reason = [&](Vec3 min, Vec3 max) {
      const auto made = raise_across(solid, chimney(solid, min, max), 0.1);
      CHECK_FALSE(made.solid);
      return made.reason;
    };
    CHECK(reason({1, 2, 5}, {2, 3, 10}) == "its foot is on one facet");
    CHECK(reason({1, 3.5, 5}, {2, 4.6, 8.9}) == "its top lies below the roof");
    CHECK(reason({-0.5, 3.5, 5}, {1, 4.6, 10}) == "its outline does not fit into the facet");
    CHECK(reason({0.05, 3.5, 5}, {1, 4.6, 10}) == "its outline does not fit into the facet");
  }

  TEST_CASE("a block keeps off other parts and draws no edge that is too short") {
    const Solid solid = solid_of(two_gables().add(box({2.05, 3.7, 5}, {2.5, 3.9, 9.5})).build());
    CHECK(raise_across(solid, chimney(solid, {1, 3.5, 5}, {2, 4.6, 10}), 0.04).solid);
    CHECK_FALSE(raise_across(solid, chimney(solid, {1, 3.5, 5}, {2, 4.6, 10}), 0.1).solid);
    CHECK_FALSE(raise_across(solid, chimney(solid, {1.8, 3.5, 5}, {2.8, 4.6, 10}), 0.1).solid);
    BlockAcross off_centre = chimney(solid, {6.2, 3.2, 5}, {7.2, 4.1, 10});
    CHECK(raise_across(solid, off_centre, 0.05).solid);
    off_centre.least_edge_m = 0.3;
    CHECK_FALSE(raise_across(solid, off_centre, 0.05).solid);
  }
}
