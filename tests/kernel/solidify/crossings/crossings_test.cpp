#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using Points = std::vector<Vec3>;

constexpr RepairOptions kCut{Closing::none, 10, Crossings::cut};

/// Ground and four walls of 4 × 2 m in plan, open above.
std::vector<Points> open_box(double height) {
  return {{{0, 0, 0}, {0, 2, 0}, {4, 2, 0}, {4, 0, 0}},
          {{0, 0, 0}, {4, 0, 0}, {4, 0, height}, {0, 0, height}},
          {{4, 0, 0}, {4, 2, 0}, {4, 2, height}, {4, 0, height}},
          {{4, 2, 0}, {0, 2, 0}, {0, 2, height}, {4, 2, height}},
          {{0, 2, 0}, {0, 0, 0}, {0, 0, height}, {0, 2, height}}};
}

Points level(Vec3 min, Vec3 max) {
  return {min, {max.x, min.y, min.z}, {max.x, max.y, min.z}, {min.x, max.y, min.z}};
}

/// A slab that runs through all four walls half a metre below their upper edge.
Building room_under_slab() {
  auto polygons = open_box(3);
  polygons.push_back(level({-1, -1, 2.5}, {5, 3, 2.5}));
  return test::building_of(polygons);
}

/// A roof of three pieces that lie over each other and cross each other's edges.
Building room_under_pieces() {
  auto polygons = open_box(3);
  polygons.push_back(level({0, 0, 3}, {4, 1.25, 3}));
  polygons.push_back(level({1, 0, 3}, {3, 2, 3}));
  polygons.push_back(level({0, 0.75, 3}, {4, 2, 3}));
  return test::building_of(polygons);
}

double volume_when_cut(const Building& building) {
  const Solidified out = solidify(building, {}, kCut);
  for (const Issue& issue : out.issues) CAPTURE(to_string(issue));
  REQUIRE(out.value.has_value());
  CHECK(is_closed(*out.value));
  return volume_m3(*out.value);
}

Building turned(Building building) {
  for (Vec3& p : building.vertices) p = test::turned(p, normalised({0.2, 0.3, 1}), 0.47);
  return test::framed(std::move(building));
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a slab that runs through walls bounds the room under it and the rest dangles") {
    const Building building = room_under_slab();
    CHECK(test::outcome_of(building, {}, {Closing::none, 10}) == "E302");
    const Solidified out = solidify(building, {}, kCut);
    REQUIRE(out.value.has_value());
    CHECK(volume_m3(*out.value) == doctest::Approx(4 * 2 * 2.5).epsilon(1e-9));
    CHECK(out.value->facets.size() == 6);
    CHECK(out.report.cut == 5);
    CHECK(out.report.dangling_area_m2 == doctest::Approx(12 * 0.5 + 6 * 4 - 4 * 2).epsilon(1e-9));
  }

  TEST_CASE("pieces of a roof that lie over each other make one roof") {
    const Solidified out = solidify(room_under_pieces(), {}, kCut);
    REQUIRE(out.value.has_value());
    CHECK(volume_m3(*out.value) == doctest::Approx(4 * 2 * 3).epsilon(1e-9));
    CHECK(out.value->facets.size() == 6);
  }

  TEST_CASE("turning a building and shuffling its polygons change nothing where polygons are cut") {
    for (const Building& building : {room_under_slab(), room_under_pieces()}) {
      const double volume = volume_when_cut(building);
      CHECK(volume_when_cut(turned(building)) == doctest::Approx(volume).epsilon(1e-6));
      for (const std::uint64_t seed : {1, 2, 3})
        CHECK(volume_when_cut(test::shuffled(building, seed)) ==
              doctest::Approx(volume).epsilon(1e-9));
    }
  }

  TEST_CASE("what is closed without it is not cut") {
    Building cube = test::BoxBody().add({0, 0, 0}, {2, 2, 2}).build();
    const Solidified out = solidify(cube, {}, kCut);
    REQUIRE(out.value.has_value());
    CHECK(out.report.cut == 0);
    CHECK_FALSE(out.report.was_needed);
  }

  TEST_CASE("polygons that cross and bound nothing stay open") {
    auto polygons = open_box(3);
    polygons.push_back(level({-1, -1, 2.5}, {2, 3, 2.5}));
    CHECK(test::outcome_of(test::building_of(polygons), {}, kCut) == "E302");
  }
}

}  // namespace
}  // namespace oriel
