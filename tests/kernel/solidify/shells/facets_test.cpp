#include "tests/support/generated_house.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::solid_of;

std::size_t loops_of(const Solid& solid) {
  std::size_t loops = 0;
  for (const Facet& facet : solid.facets) loops += facet.loops.size();
  return loops;
}

/// Every vertex of every facet lies on its plane, outer loops run counter-clockwise, holes
/// clockwise, and planes are sorted and all in use.
void check_facets(const Solid& solid) {
  std::vector<char> is_used(solid.planes.size(), 0);
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    is_used[facet.plane.index()] = 1;
    for (std::size_t l = 0; l < facet.loops.size(); ++l) {
      CHECK((signed_area_m2(solid.vertices, facet.loops[l], plane.normal) > 0) == (l == 0));
      for (const int v : facet.loops[l])
        CHECK(std::abs(dot(plane.normal, solid.vertices[static_cast<std::size_t>(v)].point) -
                       plane.offset_m) < 1e-9);
    }
    CHECK(area_m2(solid.vertices, facet, plane.normal) > 0);
    CHECK(std::ranges::is_sorted(facet.polygons));
  }
  CHECK(std::ranges::count(is_used, 0) == 0);
  CHECK(std::ranges::is_sorted(solid.planes, std::greater{}, [](const Plane& p) {
    return std::tuple(p.normal.x, p.normal.y, p.normal.z, p.offset_m);
  }));
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a box is a solid of six planes and six facets") {
    const Solid solid = solid_of(BoxBody().add({1, 2, 3}, {4, 7, 10}).build());
    CHECK(solid.planes.size() == 6);
    CHECK(solid.facets.size() == 6);
    CHECK(solid.vertices.size() == 8);
    CHECK(solid.shells.size() == 1);
    CHECK(volume_m3(solid) == doctest::Approx(105).epsilon(1e-12));
    CHECK(surface_m2(solid) == doctest::Approx(142).epsilon(1e-12));
    CHECK(box_of(solid) == Box{{1, 2, 3}, {4, 7, 10}});
    for (const Vertex& vertex : solid.vertices) CHECK(vertex.is_meeting);
    check_facets(solid);
  }

  TEST_CASE("coplanar polygons side by side become one facet") {
    // The inner boxes cut every side into a grid of polygons.
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {8, 6, 4})
                                     .add({1, 1, 1}, {2, 2, 2})
                                     .add({3, 3, 2}, {5, 4, 3})
                                     .build());
    CHECK(solid.facets.size() == 6);
    CHECK(solid.vertices.size() == 8);
    CHECK(solid.facets.front().polygons.size() == 5 * 4);
    check_facets(solid);
  }

  TEST_CASE("a pocket leaves a hole in its facet and polygons of the same plane stay apart") {
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {8, 4, 2})
                                     .remove({1, 1, 1}, {2, 2, 2})
                                     .remove({4, 1, 1}, {5, 2, 2})
                                     .build());
    CHECK(solid.facets.size() == 6 + 5 + 5);
    CHECK(loops_of(solid) == solid.facets.size() + 2);
    // The two pockets share their side planes and the plane of their floors.
    CHECK(solid.planes.size() == 6 + 4 + 2 + 1);
    CHECK(volume_m3(solid) == doctest::Approx(64 - 2).epsilon(1e-12));
    check_facets(solid);
  }

  TEST_CASE("opposite sides of a thin wall lie in two oriented planes") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, -1, -1}, {3, 5, 3}).build());
    for (const Plane& p : solid.planes)
      CHECK(std::ranges::count_if(solid.planes, [&](const Plane& q) {
              return q.coefficients == p.coefficients && q.offset == p.offset;
            }) == 1);
    CHECK(solid.facets.size() == 10);
    check_facets(solid);
  }

  TEST_CASE("triangles of a ring make the facet of the ring") {
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    Building triangles = building;
    triangles.polygons.clear();
    for (const Polygon& polygon : building.polygons) {
      const auto& ring = polygon.rings[0];
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        Polygon triangle = polygon;
        triangle.source = static_cast<int>(triangles.polygons.size());
        triangle.rings = {{ring[0], ring[i], ring[i + 1]}};
        triangles.polygons.push_back(triangle);
      }
    }
    const Solid solid = solid_of(triangles);
    CHECK(solid.facets.size() == 6);
    CHECK(solid.vertices.size() == 8);
    for (const Facet& facet : solid.facets) CHECK(facet.polygons.size() == 2);
    check_facets(solid);
  }

  TEST_CASE("facets name the polygons that make them up and each polygon once") {
    const Building building = BoxBody()
                                  .add({0, 0, 0}, {8, 4, 2})
                                  .add({1, 1, 2}, {2, 3, 3})
                                  .remove({5, 1, 1}, {6, 2, 2})
                                  .build();
    std::vector<int> named;
    for (const Facet& facet : solid_of(building).facets)
      named.insert(named.end(), facet.polygons.begin(), facet.polygons.end());
    std::ranges::sort(named);
    REQUIRE(named.size() == building.polygons.size());
    for (std::size_t i = 0; i < named.size(); ++i) CHECK(named[i] == static_cast<int>(i));
  }

  TEST_CASE("walls that differ by less than the tolerance are one plane and by more are two") {
    const auto planes_with_step = [](double step_m) {
      return solid_of(test::building_of({{{0, 0, 0}, {0, 2, 0}, {4, 2, 0}, {4, 0, 0}, {2, 0, 0}},
                                         {{0, 0, 3}, {2, 0, 3}, {4, 0, 3}, {4, 2, 3}, {0, 2, 3}},
                                         {{0, 0, 0}, {0, 0, 3}, {0, 2, 3}, {0, 2, 0}},
                                         {{4, 0, 0}, {4, 2, 0}, {4, 2, 3}, {4, 0, 3}},
                                         {{0, 2, 0}, {0, 2, 3}, {4, 2, 3}, {4, 2, 0}},
                                         {{0, 0, 0}, {2, step_m, 0}, {2, step_m, 3}, {0, 0, 3}},
                                         {{2, step_m, 0}, {4, 0, 0}, {4, 0, 3}, {2, step_m, 3}},
                                         {{0, 0, 0}, {2, 0, 0}, {2, step_m, 0}},
                                         {{2, 0, 0}, {4, 0, 0}, {2, step_m, 0}},
                                         {{0, 0, 3}, {2, step_m, 3}, {2, 0, 3}},
                                         {{2, 0, 3}, {2, step_m, 3}, {4, 0, 3}}}))
          .planes.size();
    };
    CHECK(planes_with_step(-0.001) == 6);
    CHECK(planes_with_step(-0.1) == 7);
  }

  TEST_CASE("panels almost in the plane of their wall move no vertex along it") {
    // Their planes meet that of the wall anywhere.
    generator::Options options;
    options.seed = 21;
    options.flush = 0.3;
    options.noise = 2000;
    for (int i = 2; i < 8; ++i) {
      CAPTURE(i);
      const Building building = test::generated_building(generator::generate(options, i));
      double furthest = 0;
      for (const Vertex& vertex : solid_of(building).vertices) {
        double nearest = 1;
        for (const Vec3 p : building.vertices)
          nearest = std::min(nearest, length(p - vertex.point));
        furthest = std::max(furthest, nearest);
      }
      CHECK(furthest <= 4 * Tolerances{}.plane_offset_m);
    }
  }
}

}  // namespace
}  // namespace oriel
