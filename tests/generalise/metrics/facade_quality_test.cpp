#include "generalise/metrics/facade_quality.h"

#include "generalise/metrics/legibility.h"
#include "kernel/solidify/solidify.h"
#include "tests/support/shapes.h"

#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;
using doctest::Approx;

namespace {

/// left, bottom, right, top
struct Pane {
  double left, bottom, right, top;
};

/// A wall that faces south, or west, with flush windows.
std::vector<WrittenOpening> windows(const std::vector<Pane>& panes, bool is_west = false) {
  const auto rectangle = [&](const Pane& pane) {
    const auto corner = [&](double along, double z) {
      return is_west ? Vec3{0, 20 - along, z} : Vec3{along, 0, z};
    };
    return std::vector<Vec3>{corner(pane.left, pane.bottom), corner(pane.right, pane.bottom),
                             corner(pane.right, pane.top), corner(pane.left, pane.top)};
  };
  std::vector<std::vector<Vec3>> polygons{rectangle({0, 0, 20, 10})};
  LabelledBuilding labelled;
  labelled.surfaces.push_back({"WallSurface", -1, {}});
  labelled.surface_of_polygon.push_back(0);
  for (const Pane& pane : panes) {
    polygons.push_back(rectangle(pane));
    labelled.surface_of_polygon.push_back(static_cast<int>(labelled.surfaces.size()));
    labelled.surfaces.push_back({"Window", 0, {}});
  }
  return written_openings(building_of(polygons), labelled);
}

Solid solid_of_body(const BoxBody& body) { return solidify(body.build()).value.value(); }

}  // namespace

TEST_SUITE("generalise/metrics") {
  TEST_CASE("an opening is the rectangle that it takes up in its wall whichever way that faces") {
    for (const bool is_west : {false, true}) {
      const auto found = windows({{2, 1, 3.5, 3}}, is_west);
      REQUIRE(found.size() == 1);
      CHECK(found[0].is_in_wall);
      CHECK(found[0].width_m() == Approx(1.5));
      CHECK(found[0].height_m() == Approx(2));
      CHECK(found[0].area_m2() == Approx(3));
      CHECK(found[0].offset_m == Approx(0));
    }
  }

  TEST_CASE("windows whose sills are level make an aligned row") {
    const FacadeQuality level = facade_quality(windows({{1, 1, 2, 3}, {4, 1, 5, 2.5}}));
    CHECK(level.openings == 2);
    CHECK(level.openings_m2 == Approx(3.5));
    CHECK(level.rows == 1);
    CHECK(level.aligned_rows == 1);
    CHECK(level.long_rows == 0);
    const FacadeQuality uneven = facade_quality(windows({{1, 1, 2, 3}, {4, 1.1, 5, 2.5}}));
    CHECK(uneven.rows == 1);
    CHECK(uneven.aligned_rows == 0);
    // Another storey is another row, and one alone is none.
    const FacadeQuality storeys =
        facade_quality(windows({{1, 1, 2, 3}, {4, 1, 5, 3}, {1, 4, 2, 6}}));
    CHECK(storeys.rows == 1);
  }

  TEST_CASE("a row is even if the gaps between its windows are equal") {
    CHECK(facade_quality(windows({{1, 1, 2, 2}, {4, 1, 5, 2}, {7, 1, 8, 2}})).even_rows == 1);
    const FacadeQuality uneven =
        facade_quality(windows({{1, 1, 2, 2}, {4, 1, 5, 2}, {7.5, 1, 8.5, 2}}));
    CHECK(uneven.long_rows == 1);
    CHECK(uneven.even_rows == 0);
  }

  TEST_CASE("symmetry is the share of the openings that have a mirror image") {
    CHECK(facade_quality(windows({{1, 1, 2, 2}, {8, 1, 9, 2}})).symmetry == Approx(1));
    CHECK(facade_quality(windows({{1, 1, 2, 2}, {3, 1, 4, 2}, {8, 1, 9, 2}})).symmetry ==
          Approx(2.0 / 3));
    // Half of each window lies on the image of the other.
    CHECK(facade_quality(windows({{1, 1, 2, 2}, {8, 1.5, 9, 2.5}})).symmetry == Approx(0.5));
    CHECK(facade_quality({}).symmetry == 1);
  }

  TEST_CASE("gaps between openings are counted against the least length") {
    const auto openings = windows({{1, 1, 2, 2}, {2.3, 1, 3, 2}, {1, 2.6, 2, 4}});
    const OpeningGaps gaps = opening_gaps(openings, 0.5);
    CHECK(gaps.smallest_m == Approx(0.3));
    CHECK(gaps.narrow == 1);
    CHECK(opening_gaps(openings, 0.3).narrow == 0);
    CHECK(opening_gaps(openings, 0.7).narrow == 2);
  }

  TEST_CASE("the smallest edge and gap of a body with a slot are those of the slot") {
    const Solid whole = solid_of_body(BoxBody().add({0, 0, 0}, {10, 8, 6}));
    const Legibility plain = legibility_of(whole, {}, nullptr, 0.5);
    CHECK(plain.smallest_edge_m.value() == Approx(6));
    CHECK_FALSE(plain.smallest_gap_m.has_value());
    CHECK_FALSE(plain.smallest_opening_gap_m.has_value());
    CHECK_FALSE(plain.smallest_width_m.has_value());
    const Solid slotted =
        solid_of_body(BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({3, 0, 1}, {3.25, 2, 5}));
    const Legibility found = legibility_of(slotted, {}, nullptr, 0.5);
    CHECK(found.smallest_edge_m.value() == Approx(0.25));
    CHECK(found.smallest_gap_m.value() == Approx(0.25));
    CHECK(found.narrow_gaps == 1);
    CHECK(legibility_of(slotted, {}, nullptr, 0.25).narrow_gaps == 0);
  }
}
