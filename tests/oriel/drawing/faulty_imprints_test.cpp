#include "oriel/drawing/faulty_imprints.h"

#include "kernel/segment/flush/draw_imprints.h"
#include "oriel/oriel.h"
#include "tests/support/flush.h"
#include "tests/support/segmented.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

/// A block with two flush panes in its front wall and one in its back wall.
Building block_with_panes() {
  Building building = test::plain_block();
  test::add_pane(building, 2, 1, 3, 2);
  test::add_pane(building, 5, 1, 6, 2);
  const auto back = std::ranges::find_if(building.polygons, [&](const Polygon& polygon) {
    return std::ranges::all_of(polygon.rings[0], [&](int v) {
      return building.vertices[static_cast<std::size_t>(v)].y == 8;
    });
  });
  REQUIRE(back != building.polygons.end());
  std::vector<int> ring;
  for (const Vec3 p : {Vec3{2, 8, 1}, {2, 8, 2}, {3, 8, 2}, {3, 8, 1}})
    ring.push_back(test::add_vertex(building, p));
  Polygon pane = *back;
  pane.rings = {ring};
  pane.source = static_cast<int>(building.polygons.size());
  back->rings.emplace_back(ring.rbegin(), ring.rend());
  building.polygons.push_back(std::move(pane));
  building.id = "b";
  building.is_solid = true;
  return building;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("imprints in the plane of what is not valid are left out first, then all") {
    Document document;
    document.buildings.push_back(block_with_panes());
    const Building& building = document.buildings[0];
    const PipelineResult result = segment(building);
    REQUIRE(result.is_done());
    const auto imprints = test::features_of(*result.segmentation, Sense::imprint);
    REQUIRE(imprints.size() == 3);
    const Solid drawn = draw_imprints(*result.solid, *result.segmentation, imprints);
    REQUIRE(drawn.facets.size() == 9);

    OutputCheck check(document, building);
    FaultyImprints faulty;
    CHECK_FALSE(faulty.add(check, *result.segmentation, drawn));
    CHECK(faulty.issues(result.description.table).empty());

    // A corner of a pane beyond the other side of its pane: rings cross.
    Solid crossing = drawn;
    const auto corner = std::ranges::find(crossing.vertices, Vec3{3, 0, 2}, &Vertex::point);
    REQUIRE(corner != crossing.vertices.end());
    corner->point = {1.5, 0, 0.5};
    CHECK(faulty.add(check, *result.segmentation, crossing));
    CHECK(faulty.ids().size() == 2);
    const auto issues = faulty.issues(result.description.table);
    REQUIRE(issues.size() == 2);
    for (const Issue& issue : issues) {
      CHECK(issue.code == Code::G410);
      CHECK(issue.severity == Severity::warning);
      CHECK_FALSE(issue.place.feature.empty());
    }
    CHECK_FALSE(faulty.add(check, *result.segmentation, crossing));
    CHECK(faulty.add(check, *result.segmentation, crossing));
    CHECK(faulty.ids() == imprints);
  }
}
