#include "kernel/describe/surfaces.h"

#include "kernel/solidify/solidify.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <span>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A block with a loggia, 2 m deep and 3 m high, in its front, and a slab before its side.
Building block() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 9})
      .remove({3, 0, 3}, {7, 2, 6})
      .add({10, 3, 3}, {11, 5, 3.2})
      .build();
}

/// The rows of polygons that look up, down, or sideways, in the surface table.
std::multiset<std::string> facings(const SurfaceTable& table) {
  std::multiset<std::string> found;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double inclination = table.number(row, SurfaceAttribute::inclination).value();
    found.insert(inclination < 1 ? "up" : inclination > 179 ? "down" : "wall");
  }
  return found;
}

void turn(Polygon& polygon) {
  for (auto& ring : polygon.rings) std::ranges::reverse(ring);
}

/// The row of the polygon that looks as said with its points at that height.
std::size_t row_at(const Building& building, const SurfaceTable& table, double z, bool looks_up) {
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double inclination = table.number(row, SurfaceAttribute::inclination).value();
    const bool is_level = looks_up ? inclination < 1 : inclination > 179;
    const int corner = building.polygons[row].rings[0][0];
    if (is_level && building.vertices[static_cast<std::size_t>(corner)].z == doctest::Approx(z))
      return row;
  }
  FAIL("no such surface");
  return 0;
}

}  // namespace

TEST_SUITE("kernel/describe") {
  TEST_CASE("areas of surfaces are those of the polygons") {
    const SurfaceTable table = describe_surfaces(block());
    double sum_m2 = 0;
    for (std::size_t row = 0; row < table.rows(); ++row)
      sum_m2 += table.number(row, SurfaceAttribute::area).value();
    // The block, the sides of the loggia, the sides of the slab.
    CHECK(sum_m2 == doctest::Approx(2 * 80 + 2 * 90 + 2 * 72 + 4 * (2 * 4 + 2 * 3) / 2.0 +
                                    2 * (2 * 1) + 2 * 0.2)
                        .epsilon(1e-9));
  }

  TEST_CASE("a soup that is turned inside out looks where the closed one looks") {
    const Building building = block();
    const auto solid = solidify(building);
    REQUIRE(solid.value);
    const SurfaceTable closed = describe_surfaces(building, {}, {&*solid.value, nullptr, nullptr});
    Building turned = building;
    for (Polygon& polygon : turned.polygons) turn(polygon);
    const SurfaceTable open = describe_surfaces(turned);
    REQUIRE(open.rows() == closed.rows());
    for (std::size_t row = 0; row < open.rows(); ++row) {
      CHECK(
          open.number(row, SurfaceAttribute::inclination).value() ==
          doctest::Approx(closed.number(row, SurfaceAttribute::inclination).value()).epsilon(1e-9));
      CHECK(open.text(row, SurfaceAttribute::facing) == "position");
      CHECK(closed.text(row, SurfaceAttribute::facing) == "solid");
    }
  }

  TEST_CASE("where polygons are turned at random what lies above tells the outer side") {
    const Building building = block();
    const SurfaceTable untouched = describe_surfaces(building);
    const auto expected = facings(untouched);
    const std::size_t row_of_roof = row_at(building, untouched, 9, true);
    std::size_t row_of_wall = 0;
    while (untouched.number(row_of_wall, SurfaceAttribute::inclination).value() !=
           doctest::Approx(90))
      ++row_of_wall;
    int told = 0;
    for (unsigned pattern = 1; pattern < 100; ++pattern) {
      CAPTURE(pattern);
      Building mixed = building;
      for (std::size_t i = 0; i < mixed.polygons.size(); ++i)
        if ((pattern * 2654435761U >> (i % 29)) % 2 == 1) turn(mixed.polygons[i]);
      const SurfaceTable table = describe_surfaces(mixed);
      // Where three quarters of the area agree, or disagree, that is believed of all, walls too.
      if (table.text(row_of_roof, SurfaceAttribute::facing) != "position") continue;
      if (table.text(row_of_wall, SurfaceAttribute::facing) != "input") continue;
      CHECK(facings(table) == expected);
      ++told;
    }
    CHECK(told > 20);
  }

  TEST_CASE("an overhang of one sheet makes no building of the air below it") {
    Building building = block();
    const auto corner = static_cast<int>(building.vertices.size());
    for (const Vec3 p : {Vec3{10, 0, 9}, {14, 0, 9}, {14, 8, 9}, {10, 8, 9}})
      building.vertices.push_back(p);
    Polygon sheet;
    sheet.source = static_cast<int>(building.polygons.size());
    sheet.rings = {{corner, corner + 1, corner + 2, corner + 3}};
    building.polygons.push_back(sheet);
    const SurfaceTable table = describe_surfaces(building);
    const std::size_t slab = row_at(building, table, 3.2, true);
    CHECK(table.number(slab, SurfaceAttribute::gap_above).value() == doctest::Approx(5.8));
    // One side of four, 2 m of 6 m, is at the wall.
    CHECK(table.number(slab, SurfaceAttribute::wall_up).value() ==
          doctest::Approx(2.0 / 6).epsilon(1e-9));
  }

  TEST_CASE("a loggia has a ceiling above its floor and walls around it") {
    const Building building = block();
    const SurfaceTable table = describe_surfaces(building);
    const std::size_t floor = row_at(building, table, 3, true);
    const std::size_t ceiling = row_at(building, table, 6, false);
    CHECK(table.number(floor, SurfaceAttribute::gap_above).value() == doctest::Approx(3));
    CHECK(table.number(ceiling, SurfaceAttribute::gap_below).value() == doctest::Approx(3));
    CHECK(table.number(floor, SurfaceAttribute::wall_up).value() ==
          doctest::Approx(8.0 / 12).epsilon(0.2));
    CHECK(table.number(floor, SurfaceAttribute::base_height).value() == doctest::Approx(3));
    const std::size_t roof = row_at(building, table, 9, true);
    CHECK_FALSE(table.number(roof, SurfaceAttribute::gap_above));
    CHECK(table.number(roof, SurfaceAttribute::below_ridge).value() == doctest::Approx(0));
    const std::size_t ground = row_at(building, table, 0, false);
    CHECK_FALSE(table.number(ground, SurfaceAttribute::gap_below));
    CHECK(table.number(ground, SurfaceAttribute::base_height).value() == doctest::Approx(0));
  }

  TEST_CASE("what is measured of a surface does not depend on what else is") {
    const Building building = block();
    const SurfaceTable all = describe_surfaces(building);
    for (int row = 0; row < static_cast<int>(all.rows()); ++row) {
      SurfaceSurvey survey(building);
      // The costliest first.
      for (auto what = kSurfaceMeasures.rbegin(); what != kSurfaceMeasures.rend(); ++what)
        survey.measure(*what, {&row, 1});
      for (const SurfaceAttribute attribute : kSurfaceAttributes) {
        if (info_of(attribute).unit == Unit::text) continue;
        CAPTURE(info_of(attribute).name);
        const auto r = static_cast<std::size_t>(row);
        CHECK(survey.table().number(r, attribute) == all.number(r, attribute));
      }
    }
    SurfaceSurvey untouched(building);
    for (const SurfaceAttribute attribute : kSurfaceAttributes) {
      if (!measure_of(attribute)) continue;
      for (std::size_t row = 0; row < all.rows(); ++row)
        CHECK_FALSE(untouched.table().number(row, attribute));
    }
  }

  TEST_CASE("what is told of some surfaces only is what is told of them among all") {
    const Building building = block();
    const auto solid = solidify(building, {});
    REQUIRE(solid.value);
    const SurfaceContext context{&*solid.value, nullptr, nullptr, nullptr};
    SurfaceSurvey all(building, {}, context);
    for (int row = 0; row < static_cast<int>(all.table().rows()); ++row) {
      SurfaceSurvey one(building, {}, context, std::span(&row, 1));
      REQUIRE(one.table().rows() == all.table().rows());
      for (const SurfaceAttribute attribute : kSurfaceAttributes)
        for (std::size_t other = 0; other < all.table().rows(); ++other) {
          const bool is_asked = other == static_cast<std::size_t>(row);
          if (info_of(attribute).unit == Unit::text)
            CHECK(one.table().text(other, attribute) ==
                  (is_asked ? all.table().text(other, attribute) : ""));
          else
            CHECK(one.table().number(other, attribute) ==
                  (is_asked ? all.table().number(other, attribute) : std::nullopt));
        }
    }
  }

  TEST_CASE("facets that no polygon made are synthetic") {
    auto solid = solidify(block());
    REQUIRE(solid.value);
    solid.value->facets[0].polygons.clear();
    const SurfaceTable table = describe_facets(*solid.value);
    REQUIRE(table.rows() == solid.value->facets.size());
    for (std::size_t row = 0; row < table.rows(); ++row)
      CHECK(table.number(row, SurfaceAttribute::synthetic).value() == (row == 0 ? 1 : 0));
  }
}
