#include "kernel/segment/flush/subdivisions.h"

#include "kernel/segment/rings/ring_features.h"
#include "kernel/solidify/open_shell.h"
#include "tests/support/shapes.h"

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

/// A wall with an opening, and `count` polygons upon each other in the opening. No two points are
/// welded, so that the wall and what fills it are one subdivision.
Subdivisions wall_with_copies(int count) {
  Building wall = test::building_of({{{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}}});
  const int first = static_cast<int>(wall.vertices.size());
  for (const Vec3 p : {Vec3{1, 0, 1}, Vec3{2, 0, 1}, Vec3{2, 0, 2}, Vec3{1, 0, 2}})
    wall.vertices.push_back(p);
  wall.polygons[0].rings.push_back({first + 3, first + 2, first + 1, first});
  Solid solid;
  solid.planes.resize(1);
  solid.planes[0].normal = {0, -1, 0};
  solid.facets = {{PlaneId{0}, {}, {0}}};
  for (int i = 1; i <= count; ++i) {
    Polygon pane = wall.polygons[0];
    pane.rings = {{first, first + 1, first + 2, first + 3}};
    pane.source = i;
    wall.polygons.push_back(pane);
    solid.facets[0].polygons.push_back(i);
  }
  Work work;
  return subdivisions_of(wall, solid, {}, work);
}

}  // namespace

TEST_SUITE("kernel/segment") {
  TEST_CASE("an edge of a subdivision is the twin of its twin where polygons lie upon each other") {
    for (const int count : {1, 2, 3}) {
      CAPTURE(count);
      const Subdivisions found = wall_with_copies(count);
      REQUIRE(found.subdivisions.size() == 1);
      REQUIRE(std::ssize(found.polygons) == 1 + count);
      int paired = 0;
      for (const InputEdgeId e : found.edges.ids()) {
        const InputEdgeId twin = found.edges[e].twin;
        if (!twin.is_valid()) continue;
        ++paired;
        CHECK(found.edges[twin].twin == e);
      }
      CHECK(paired == 8);
    }
  }

  TEST_CASE("a polygon that welding folds onto itself has no facet in an open building") {
    // What remains at a weld of 1 mm: a polygon that goes out and back along the same edges.
    const std::vector<Vec3> folded{{0, 0, 0}, {0.003, 0, 0}, {0.003, 0.0001, 0}, {0, 0.0001, 0}};
    const std::vector<Vec3> floor{{0, 3, 0}, {2, 3, 0}, {2, 5, 0}, {0, 5, 0}};
    const auto shell = open_shell(test::building_of({folded, floor}));
    REQUIRE(shell.has_value());
    for (const Facet& facet : shell->facets) CHECK_FALSE(facet.loops.empty());
    // As it came to us, in millimetres: faults/crash-ground-facet of the shared data.
    const auto mm = [](std::vector<Vec3> points) {
      for (Vec3& p : points) p = 0.001 * p;
      return points;
    };
    const auto small =
        open_shell(test::building_of({mm({{2, 3, 1}, {5, 3, 1}, {5, 3, 4}, {2, 3, 4}}),
                                      mm({{5, 4, 1}, {2, 4, 1}, {2, 4, 4}, {5, 4, 4}}),
                                      mm({{2, 2, 1}, {3, 6, 4}, {3, 5, 1}, {3, 2, 1}}),
                                      mm({{3, 5, 1}, {3, 6, 4}, {5, 5, 0}, {3, 5, 3}})}));
    REQUIRE(small.has_value());
    for (const Facet& facet : small->facets) CHECK_FALSE(facet.loops.empty());
  }
}

}  // namespace oriel::detail
