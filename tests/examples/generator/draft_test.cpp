#include "examples/generator/house/extrude.h"
#include "examples/generator/output/check.h"

#include <doctest/doctest.h>

namespace oriel::generator {
namespace {

/// A cube of 2 m with one object; its facets are returned.
BlockFacets add_cube(Draft& draft) {
  const int object = draft.add_object({Class::wall, "WallSurface", -1, -1, {}, {}});
  return add_block(draft, {}, {0, 2000_mm, 0, 2000_mm, 0, 2000_mm}, {object});
}

TEST_SUITE("examples/generator") {
  TEST_CASE("a pocket becomes a hole in the facet it is carved from") {
    Draft draft;
    const BlockFacets cube = add_cube(draft);
    carve_block(draft, {}, {500_mm, 1500_mm, 500_mm, 1500_mm, 1500_mm, 2000_mm}, {0},
                {.front = cube.front});
    const Body body = draft.close();
    CHECK(find_faults(body, 0).empty());
    CHECK(body.polygons.size() == 11);
    CHECK(volume_m3(body) == doctest::Approx(7.5).epsilon(1e-12));
  }

  TEST_CASE("a pocket at the edge notches both facets that meet there") {
    Draft draft;
    const BlockFacets cube = add_cube(draft);
    carve_block(draft, {}, {500_mm, 1500_mm, 0, 1000_mm, 1500_mm, 2000_mm}, {0},
                {.bottom = cube.bottom, .front = cube.front});
    const Body body = draft.close();
    CHECK(find_faults(body, 0).empty());
    CHECK(body.polygons.size() == 10);
    for (const Polygon& polygon : body.polygons) CHECK(polygon.rings.size() == 1);
    CHECK(volume_m3(body) == doctest::Approx(7.5).epsilon(1e-12));
  }

  TEST_CASE("boxes glued side by side leave no seam") {
    Draft draft;
    const BlockFacets cube = add_cube(draft);
    add_block(draft, {}, {2000_mm, 3000_mm, 0, 2000_mm, 0, 2000_mm}, {0},
              {.left = cube.right,
               .bottom = cube.bottom,
               .top = cube.top,
               .back = cube.back,
               .front = cube.front});
    const Body body = draft.close();
    CHECK(find_faults(body, 0).empty());
    CHECK(body.polygons.size() == 6);
    CHECK(body.vertices.size() == 8);
  }

  TEST_CASE("a slot through a facet's middle leaves two polygons") {
    Draft draft;
    const BlockFacets cube = add_cube(draft);
    carve_block(draft, {}, {500_mm, 1500_mm, 0, 2000_mm, 1500_mm, 2000_mm}, {0},
                {.bottom = cube.bottom, .top = cube.top, .front = cube.front});
    const Body body = draft.close();
    CHECK(find_faults(body, 0).empty());
    CHECK(body.polygons.size() == 10);
  }

  TEST_CASE("the check finds what is wrong with a body") {
    Draft draft;
    add_cube(draft);
    const Body cube = draft.close();
    CHECK(find_faults(cube, 0).empty());

    Body open = cube;
    open.polygons.pop_back();
    CHECK_FALSE(find_faults(open, 0).empty());

    Body turned = cube;
    std::swap(turned.polygons[0].rings[0][0], turned.polygons[0].rings[0][2]);
    CHECK_FALSE(find_faults(turned, 0).empty());

    Body bent = cube;
    bent.vertices[0].x -= 5;
    CHECK_FALSE(find_faults(bent, 1).empty());
    CHECK(find_faults(bent, 10).empty());

    Body inside_out = cube;
    for (Point& p : inside_out.vertices) p.x = -p.x;
    CHECK(find_faults(inside_out, 0) == std::vector<std::string>{"the volume is not positive"});

    Body nameless = cube;
    nameless.objects.push_back({Class::chimney, "chimney", 0, -1, {}, "chimney_1"});
    CHECK(find_faults(nameless, 0) == std::vector<std::string>{"chimney_1 has no polygons"});
  }
}

}  // namespace
}  // namespace oriel::generator
