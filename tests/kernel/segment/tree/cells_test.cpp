#include "tests/support/segmented.h"
#include "tests/support/shapes.h"

#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

Box box_of_facet(const Segmentation& segmentation, const Facet& facet) {
  Box box;
  for (const Loop& loop : facet.loops)
    for (const int v : loop) box.grow(segmentation.vertices[static_cast<std::size_t>(v)].point);
  return box;
}

bool lies_in(const Box& box, Vec3 p) {
  constexpr double kGrid_m = 0.001;
  return p.x >= box.min.x - kGrid_m && p.x <= box.max.x + kGrid_m && p.y >= box.min.y - kGrid_m &&
         p.y <= box.max.y + kGrid_m && p.z >= box.min.z - kGrid_m && p.z <= box.max.z + kGrid_m;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a polygon of a facet that is cut belongs to the part that it lies in") {
    // A block and wings as high as it, on the same ground: roof and ground are cut with them.
    const test::Segmented s = test::segmented(test::BoxBody()
                                                  .add({0, 0, 0}, {6, 6, 4})
                                                  .add({6, 2, 0}, {8, 4, 4})
                                                  .add({-2, 1, 0}, {0, 3, 4})
                                                  .build());
    REQUIRE(s.segmentation.cells.size() > 1);
    std::vector<int> uses(s.building.polygons.size(), 0);
    for (const Cell& cell : s.segmentation.cells)
      for (const Facet& facet : cell.facets)
        for (const int source : facet.polygons) {
          ++uses[static_cast<std::size_t>(source)];
          Box polygon;
          for (const int v : s.building.polygons[static_cast<std::size_t>(source)].rings[0])
            polygon.grow(s.building.vertices[static_cast<std::size_t>(v)]);
          CHECK(lies_in(box_of_facet(s.segmentation, facet), 0.5 * (polygon.min + polygon.max)));
        }
    for (const int count : uses) CHECK(count == 1);
  }
}

}  // namespace
}  // namespace oriel
