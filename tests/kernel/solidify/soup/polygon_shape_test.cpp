#include "kernel/solidify/soup/polygon_shape.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

/// A soup of one polygon.
Soup soup_of(std::vector<exact::GridPoint> points, const std::vector<std::vector<int>>& rings) {
  Soup soup;
  soup.grid_m = 1.0 / 1024;
  soup.points = std::move(points);
  soup.polygons.resize(1);
  for (const auto& ring : rings) {
    soup.corners.insert(soup.corners.end(), ring.begin(), ring.end());
    soup.first_corner.push_back(soup.corner_count());
  }
  soup.first_ring.push_back(soup.ring_count());
  return soup;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("an arcsine is above a limit whether or not it has to be taken") {
    CHECK(rc::check([] {
      const double sine = *rc::gen::inRange(0, 1000001) / 1e6;
      const double limit = *rc::gen::inRange(0, 1570001) / 1e6;
      RC_ASSERT(is_arcsine_above(sine, limit) == (std::asin(sine) > limit));
    }));
    for (const double sine : {0.0, 1e-9, 0.008726, 0.5, 0.999, 1.0}) {
      const double limit = std::asin(sine);
      CHECK_FALSE(is_arcsine_above(sine, limit));
      if (sine > 0) CHECK(is_arcsine_above(sine, std::nextafter(limit, 0)));
    }
  }

  TEST_CASE("the area of a polygon is without its hole, whatever corner it starts at") {
    const std::vector<exact::GridPoint> points{{0, 0, 5}, {0, 9, 5}, {2, 2, 5}, {2, 4, 5},
                                               {4, 2, 5}, {4, 4, 5}, {9, 0, 5}, {9, 9, 5}};
    std::vector<int> outer{0, 6, 7, 1}, hole{2, 3, 5, 4};
    for (int turn = 0; turn < 4; ++turn) {
      std::ranges::rotate(outer, outer.begin() + 1);
      std::ranges::rotate(hole, hole.begin() + 1);
      const Soup soup = soup_of(points, {outer, hole});
      const PolygonShape shape = shapes_of(soup).front();
      REQUIRE(shape.normal);
      CHECK(*shape.normal == IntegerNormal{0, 0, 1});
      CHECK(shape.area == 77);
      CHECK(height_of(soup, 0, shape.area) == doctest::Approx(77 / std::sqrt(162.0)));
      CHECK(offset_if_flat(soup, 0, *shape.normal) == 5);
    }
  }

  TEST_CASE("a polygon with a vertex off its plane is not flat, and one on a line has no normal") {
    const Soup warped = soup_of({{0, 0, 0}, {0, 9, 0}, {9, 0, 0}, {9, 9, 1}}, {{0, 2, 3, 1}});
    CHECK_FALSE(offset_if_flat(warped, 0, {0, 0, 1}));
    const OffsetSpan span = span_along(warped, 0, {0, 0, 1});
    CHECK(span.low == 0);
    CHECK(span.high == 1);
    const Soup line = soup_of({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}});
    CHECK_FALSE(shapes_of(line).front().normal);
  }
}

}  // namespace
}  // namespace oriel::detail
