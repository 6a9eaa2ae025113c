#include "generalise/invariants/invariants.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// What the change from one body to the other breaks, or "".
std::string broken(const Solid& before, const Solid& after, const Invariants& invariants) {
  const auto found =
      violation(measures_of(before, invariants), measures_of(after, invariants), invariants);
  return found ? to_string(found->code) + " " + found->sentence : "";
}

Invariants limited(Limits limits) {
  Invariants invariants;
  invariants.limits = limits;
  return invariants;
}

/// A house of 12 x 8 m with eaves at 6 m and its ridge at 9 m, `up_m` higher and with a mast
/// beside.
Solid house(double up_m = 0, bool has_mast = false) {
  Building building = gabled_house();
  for (Vec3& p : building.vertices)
    if (p.z > 1) p.z += up_m;
  if (has_mast) {
    const Building mast = BoxBody().add({20, 0, 0}, {20.5, 0.5, 12}).build();
    for (Polygon polygon : mast.polygons) {
      for (auto& ring : polygon.rings)
        for (int& v : ring) v += static_cast<int>(building.vertices.size());
      polygon.source = static_cast<int>(building.polygons.size());
      building.polygons.push_back(std::move(polygon));
    }
    building.vertices.insert(building.vertices.end(), mast.vertices.begin(), mast.vertices.end());
  }
  return solid_of(building);
}

Building moved(Building building, Vec3 by, const std::string& id) {
  for (Vec3& p : building.vertices) p = p + by;
  building.id = id;
  return building;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a gabled roof has two eaves and a ridge") {
    const RoofLines lines = roof_lines(house());
    REQUIRE(main_height_m(lines.eaves));
    CHECK(*main_height_m(lines.eaves) == doctest::Approx(6));
    CHECK(length_near_m(lines.eaves, 6, 0.1) == doctest::Approx(24));
    REQUIRE(main_height_m(lines.ridges));
    CHECK(*main_height_m(lines.ridges) == doctest::Approx(9));
    CHECK(length_near_m(lines.ridges, 9, 0.1) == doctest::Approx(12));
  }

  TEST_CASE("a flat roof has eaves all round and no ridge, a valley is neither") {
    const RoofLines flat = roof_lines(solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).build()));
    CHECK(length_near_m(flat.eaves, 6, 0) == doctest::Approx(36));
    CHECK(flat.ridges.empty());
    // Two slopes that fall towards each other: a valley at 5 m between upper edges at 6 m.
    const RoofLines valley =
        roof_lines(solid_of(building_of({{{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}},
                                         {{0, 0, 6}, {5, 0, 5}, {5, 8, 5}, {0, 8, 6}},
                                         {{5, 0, 5}, {10, 0, 6}, {10, 8, 6}, {5, 8, 5}},
                                         {{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {5, 0, 5}, {0, 0, 6}},
                                         {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {5, 8, 5}, {10, 8, 6}},
                                         {{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}},
                                         {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, {10, 0, 6}}})));
    CHECK(valley.eaves.empty());
    CHECK(length_near_m(valley.ridges, 6, 0) == doctest::Approx(16));
    CHECK(length_near_m(valley.ridges, 5, 0) == doctest::Approx(0));
  }

  TEST_CASE("a roof that moves breaks what says so and nothing else") {
    CHECK(broken(house(), house(0.4), limited({.ridge_m = 0.5, .eaves_m = 0.5})) == "");
    CHECK(broken(house(), house(0.6), limited({.ridge_m = 0.5})) ==
          "G405 its ridge would move by more than 0.5 m");
    CHECK(broken(house(), house(0.6), limited({.eaves_m = 0.5})) ==
          "G405 its eaves would move by more than 0.5 m");
    CHECK(broken(house(), house(0.6), {}) == "");
  }

  TEST_CASE("the ridge stays where what is higher goes") {
    CHECK(broken(house(0, true), house(), limited({.ridge_m = 0.1, .eaves_m = 0.1})) == "");
    CHECK(broken(house(0, true), house(), limited({.top_m = 0.1})) ==
          "G405 its highest point would move by 3 m, more than 0.1 m");
  }

  TEST_CASE("a change that is small but too large is told in digits that show it") {
    const Solid before = solid_of(BoxBody().add({0, 0, 0}, {10, 10, 10}).build());
    const Solid after = solid_of(
        BoxBody().add({0, 0, 0}, {10, 10, 10}).remove({9, 9, 9.957}, {10, 10, 10}).build());
    CHECK(broken(before, after, limited({.volume_pct = 0.001})) ==
          "G405 the volume would change by 0.0043 %, more than 0.001 %");
  }

  TEST_CASE("walls against other buildings are found, and those lost or gained are told") {
    const BoxBody block = BoxBody().add({0, 0, 0}, {10, 8, 6});
    const Building building = block.build("a");
    // To the right one that is 4 m high and stands back by 2 m; one that touches along an edge
    // only; one that is 2 cm off.
    const std::vector<Building> all{
        building, moved(BoxBody().add({0, 2, 0}, {5, 8, 4}).build(), {10, 0, 0}, "b"),
        moved(block.build(), {-10, 8, 0}, "c"), moved(block.build(), {0, 8.02, 0}, "d")};
    const Solid solid = solid_of(building);
    Invariants invariants = limited({.party_walls_pct = 10});
    invariants.party_walls = party_walls(building, solid, all);
    CHECK(shared_m2(solid, invariants.party_walls) == doctest::Approx(24));
    const Solid cut =
        solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({8, 4, 3}, {10, 8, 6}).build());
    CHECK(broken(solid, cut, invariants) ==
          "G405 its party walls would change by 16.7 %, more than 10 %");
    invariants.limits.party_walls_pct = 17;
    CHECK(broken(solid, cut, invariants) == "");
    CHECK(broken(cut, solid, invariants) ==
          "G405 its party walls would change by 20 %, more than 17 %");
  }

  TEST_CASE("a wall with a hole in it is no party wall there") {
    const Building building = BoxBody().add({0, 0, 0}, {10, 8, 6}).build("a");
    Building other = in_whole_facets(
        BoxBody().add({10, 0, 0}, {15, 8, 6}).remove({10, 2, 1}, {12, 4, 3}).build());
    other.id = "b";
    const Solid solid = solid_of(building);
    const auto walls = party_walls(building, solid, std::vector<Building>{building, other});
    CHECK(shared_m2(solid, walls) == doctest::Approx(48 - 4));
  }

  TEST_CASE("of two limits the stricter holds") {
    const Limits one{.volume_pct = 5, .eaves_m = 0.5}, other{.volume_pct = 2, .ridge_m = 1};
    const Limits both{.volume_pct = 2, .ridge_m = 1, .eaves_m = 0.5};
    CHECK(stricter(one, other) == both);
    CHECK(stricter(other, one) == both);
    CHECK(stricter(one, {}) == one);
  }
}
