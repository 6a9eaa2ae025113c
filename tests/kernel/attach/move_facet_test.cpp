#include "kernel/attach/move_facet.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <string>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr Vec3 kForwards{0, -1, 0}, kUpwards{0, 0, 1};

/// A block of 10 x 8 x 6 m with two windows of 0.2 m in its front.
Solid with_windows() {
  return solid_of(BoxBody()
                      .add({0, 0, 0}, {10, 8, 6})
                      .remove({1, 0, 1}, {2, 0.2, 2})
                      .remove({5, 0, 1}, {6, 0.2, 2})
                      .build());
}

std::string reason_of(const Solid& solid, Vec3 direction, double out_m) {
  const MovedFacet moved = move_facet(solid, facet_looking(solid, direction), out_m);
  CHECK_FALSE(moved.solid);
  return moved.reason;
}

}  // namespace

TEST_SUITE("kernel/attach") {
  TEST_CASE("a wall that moves takes its area times the way with it") {
    const Solid solid = with_windows();
    for (const double out_m : {0.25, -0.125}) {
      const MovedFacet moved = move_facet(solid, facet_looking(solid, kForwards), out_m);
      REQUIRE_MESSAGE(moved.solid, moved.reason);
      CHECK(is_closed(*moved.solid));
      CHECK(volume_m3(*moved.solid) ==
            doctest::Approx(volume_m3(solid) + 58 * out_m).epsilon(1e-9));
      CHECK(box_of(*moved.solid).min.y == doctest::Approx(-out_m));
      CHECK(moved.solid->facets.size() == solid.facets.size());
    }
  }

  TEST_CASE("the slopes of a roof follow the gable wall that moves") {
    const Solid solid = solid_of(gabled_house());
    const MovedFacet moved = move_facet(solid, facet_looking(solid, {1, 0, 0}), 0.5);
    REQUIRE_MESSAGE(moved.solid, moved.reason);
    CHECK(is_closed(*moved.solid));
    CHECK(volume_m3(*moved.solid) == doctest::Approx(volume_m3(solid) / 12 * 12.5).epsilon(1e-9));
  }

  TEST_CASE("there and back again is where it was") {
    const Solid solid = with_windows();
    const FacetId front = facet_looking(solid, kForwards);
    const MovedFacet there = move_facet(solid, front, 0.3);
    REQUIRE(there.solid);
    const MovedFacet back = move_facet(*there.solid, front, -0.3);
    REQUIRE(back.solid);
    for (std::size_t v = 0; v < solid.vertices.size(); ++v)
      CHECK(length(back.solid->vertices[v].point - solid.vertices[v].point) < 1e-9);
  }

  TEST_CASE("a facet does not move through what lies behind or before it") {
    CHECK(reason_of(with_windows(), kForwards, -0.2) == "an edge of it would vanish");
    CHECK(reason_of(with_windows(), kForwards, -9) == "an edge of it would vanish");
    CHECK(reason_of(with_windows(), kForwards, 0) == "it would move by nothing");
    // The roof of the low part would rise past the eaves of the high one's canopy.
    const Solid under = solid_of(BoxBody()
                                     .add({0, 0, 0}, {10, 8, 3})
                                     .add({0, 6, 3}, {10, 8, 9})
                                     .add({3, 4, 5}, {5, 6, 5.5})
                                     .build());
    CHECK(reason_of(under, kUpwards, 2.5) == "something lies in its way");
    CHECK(move_facet(under, facet_looking(under, kUpwards), 1).solid);
  }

  TEST_CASE("a corner of four planes cannot follow") {
    // Two gables that meet at one height: four slopes and no more at their crossing.
    const Solid pyramid = solid_of(building_of({{{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}},
                                                {{0, 0, 0}, {4, 0, 0}, {2, 2, 3}},
                                                {{4, 0, 0}, {4, 4, 0}, {2, 2, 3}},
                                                {{4, 4, 0}, {0, 4, 0}, {2, 2, 3}},
                                                {{0, 4, 0}, {0, 0, 0}, {2, 2, 3}}}));
    CHECK(move_facet(pyramid, FacetId{1}, 0.1).reason ==
          "more than three planes meet in one of its corners");
  }
}
