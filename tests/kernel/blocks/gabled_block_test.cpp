#include "kernel/blocks/gabled_block.h"

#include "kernel/blocks/upright_block.h"
#include "kernel/validate/validate.h"
#include "model/tolerances.h"

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("kernel/blocks") {
  TEST_CASE("eaves run along the parallel edges that lie along the ridge") {
    const Outline row{{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {0, 10, 0}};
    const auto along = under_ridge(row, {1, 0.05, 0});
    REQUIRE(along);
    CHECK(along->front().x == 0);
    const Outline upright{{0, 0, 0}, {10, 0, 0}, {10, 30, 0}, {0, 30, 0}};
    const auto turned = under_ridge(upright, {0, -1, 0});
    REQUIRE(turned);
    CHECK(turned->front().x == 10);
    CHECK_FALSE(under_ridge(row, {0, 1, 0}));      // across
    CHECK_FALSE(under_ridge(row, {1, 1, 0}));      // slanting
    CHECK_FALSE(under_ridge(upright, {1, 0, 0}));  // along the short edges
    CHECK_FALSE(under_ridge({{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {0, 12, 0}}, {1, 0, 0}));
    CHECK_FALSE(under_ridge({{0, 0, 0}, {30, 0, 0}, {5, 2, 0}, {0, 10, 0}}, {1, 0, 0}));
    CHECK_FALSE(under_ridge({{0, 0, 0}, {30, 0, 0}, {15, 10, 0}}, {1, 0, 0}));
  }

  TEST_CASE("a gabled block is a valid solid, also over ends that are not square") {
    for (const Outline& outline :
         {Outline{{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {0, 10, 0}},
          Outline{{0, 0, 0}, {30, 0, 0}, {26.001, 9.003, 0}, {2, 9.003, 0}},
          Outline{{0.001, 0, 0}, {21, 21.002, 0}, {14, 28, 0}, {-7, 7, 0}}}) {
      const Building faces = faces_of({outline, -1, 5, 8.5}, 0.001);
      CHECK(validate(faces).empty());
      const auto solid = block_solid(faces, Tolerances{});
      REQUIRE(solid);
      CHECK(solid->facets.size() == 7);
    }
  }
}
