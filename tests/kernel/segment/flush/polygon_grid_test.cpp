#include "kernel/segment/flush/polygon_grid.h"

#include "tests/support/shapes.h"

#include <cfenv>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::detail {

TEST_SUITE("kernel/segment") {
  TEST_CASE("a polygon without corners is in no cell of the grid") {
    Building building = test::building_of({{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}});
    Polygon empty = building.polygons[0];
    empty.source = 1;
    empty.rings = {{}};
    building.polygons.push_back(empty);
    // The middle of nothing is no number, and as a whole number it has no value.
    std::feclearexcept(FE_INVALID);
    const PolygonGrid grid(building, 1e-4);
    CHECK(std::fetestexcept(FE_INVALID) == 0);
    CHECK(grid.polygons().size() == 2);
    CHECK(grid.of(1).outline().empty());
    CHECK(grid.within({{-1, -1, -1}, {5, 5, 5}}) == std::vector<int>{0});
  }
}

}  // namespace oriel::detail
