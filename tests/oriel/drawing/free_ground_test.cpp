#include "oriel/drawing/targets.h"
#include "tests/support/shapes.h"

#include <utility>

#include <doctest/doctest.h>

namespace {

oriel::Document street() {
  oriel::Document document;
  for (const auto& [id, x] : {std::pair{"a", 0.0}, std::pair{"b", 30.0}}) {
    oriel::Building building = oriel::test::BoxBody().add({0, 0, 0}, {10, 8, 6}).build();
    building.id = id;
    building.frame.origin_m = {1000 + x, 2000, 0};
    document.buildings.push_back(std::move(building));
  }
  return document;
}

oriel::Box box_from(double x, double width_m) { return {{x, 0, 0}, {x + width_m, 1, 0}}; }

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("ground is free where no other building of the file stands") {
    const oriel::Document document = street();
    const auto is_free = oriel::free_ground(document, document.buildings[0]);
    REQUIRE(is_free);
    CHECK(is_free(box_from(12, 5)));
    // The other building begins 30 m from this one's origin, however high it is.
    CHECK_FALSE(is_free(box_from(28, 5)));
    CHECK_FALSE(is_free(box_from(35, 1)));
    CHECK(is_free(box_from(-5, 4)));
    CHECK_FALSE(oriel::free_ground(document, document.buildings[1])(box_from(-25, 1)));
  }

  TEST_CASE("of a building alone nobody knows what stands beside it") {
    oriel::Document document = street();
    document.buildings.pop_back();
    CHECK_FALSE(oriel::free_ground(document, document.buildings[0]));
  }
}
