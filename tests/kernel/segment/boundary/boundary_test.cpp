#include "kernel/segment/boundary/boundary.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::Boundary;
using detail::FlatBody;
using detail::PlaneSide;
using detail::World;

std::vector<std::pair<PointId, PointId>> living_edges_of(const Boundary& body) {
  std::vector<std::pair<PointId, PointId>> edges;
  for (const EdgeId e : body.half_edge_ids())
    if (body.is_alive_edge(e)) edges.emplace_back(std::minmax(body.origin(e), body.target(e)));
  std::ranges::sort(edges);
  return edges;
}

void check_lists(const Boundary& body) {
  FlatBody flat(body);
  std::vector<std::pair<PointId, PointId>> twice;
  for (const FlatBody::EdgePoints& edge : flat.edges())
    twice.insert(twice.end(), 2, std::minmax(edge.from, edge.to));
  std::ranges::sort(twice);
  CHECK(twice == living_edges_of(body));
  std::vector<detail::BodyFacetId> facets;
  const detail::PlaneTable& planes = body.world().planes;
  for (const FlatBody::RankedFacet& facet : flat.facets()) {
    facets.push_back(facet.number);
    const int plane = body.facet(facet.number).side >> 1;
    CHECK(facet.normal_class == planes.class_of(plane));
    CHECK(facet.rank == planes.rank_of(plane));
  }
  CHECK(facets == body.living_facets());
}

/// Fills the first hole of a facet; what lay inside goes. False if there is none.
bool fill_a_hole(Boundary& body) {
  for (const detail::BodyFacetId f : body.living_facets())
    for (const LoopId l : body.facet(f).loops) {
      if (!body.loop(l).is_hole) continue;
      std::vector<detail::BodyFacetId> inside{body.facet_of(body.twin(body.loop(l).first))};
      for (std::size_t i = 0; i < inside.size(); ++i)
        body.for_each_edge(inside[i], [&](EdgeId e) {
          const detail::BodyFacetId g = body.facet_of(body.twin(e));
          if (g != f && std::ranges::find(inside, g) == inside.end()) inside.push_back(g);
        });
      const double area = -body.loop(l).area;
      body.remove(inside);
      body.fill_hole(l, area);
      return true;
    }
  return false;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("corners closer than the grid are each put on an edge once") {
    // A U whose two inner corners come down to its lower edge.
    const Building u =
        test::BoxBody().add({0, 0, 0}, {4, 4, 1}).remove({1, 2, 0}, {3, 4, 1}).build();
    Solid solid = test::solid_of(u);
    for (Vertex& v : solid.vertices)
      if (v.point.y == 2) v = {{v.point.x < 2 ? 2 : 2 + 0.6 * solid.grid_m, 0, v.point.z}, false};
    World world(solid);
    Boundary body = boundary_of(solid, 0, world);
    const int before = body.half_edge_count();
    for (const detail::BodyFacetId f : body.living_facets()) body.zip(f);
    CHECK(body.half_edge_count() > before);
    CHECK(body.half_edge_count() <= before * before);
  }

  TEST_CASE("a flat body lists each living edge once and each living facet with its rank") {
    int filled = 0;
    for (const test::NamedBody& named : test::bodies()) {
      CAPTURE(std::string(named.name));
      const Solid solid = test::solid_of(named.make(), {});
      World world(solid);
      Boundary body = boundary_of(solid, 0, world);
      check_lists(body);
      if (!fill_a_hole(body)) continue;
      ++filled;
      check_lists(body);
    }
    CHECK(filled > 0);
  }

  TEST_CASE("without what is dead a body has the same edges and facets in the same order") {
    for (const test::NamedBody& named : test::bodies()) {
      CAPTURE(std::string(named.name));
      const Solid solid = test::solid_of(named.make(), {});
      World world(solid);
      Boundary body = boundary_of(solid, 0, world);
      if (!fill_a_hole(body)) continue;
      REQUIRE(body.dead_edge_count() > 0);
      const Boundary living = body.without_dead();
      check_lists(living);
      CHECK(living.dead_edge_count() == 0);
      CHECK(living.half_edge_count() == body.half_edge_count() - body.dead_edge_count());
      CHECK(living.volume() == body.volume());
      CHECK(living.sides() == body.sides());
      std::vector<PointId> before, after;
      for (const EdgeId e : body.half_edge_ids())
        if (body.is_alive_edge(e)) before.push_back(body.origin(e));
      for (const EdgeId e : living.half_edge_ids()) after.push_back(living.origin(e));
      CHECK(before == after);
      for (const PlaneSide side : body.sides()) {
        CHECK(living.area_on(side) == body.area_on(side));
        CHECK(living.facets_on(side).size() == body.facets_on(side).size());
      }
    }
  }
}

}  // namespace
}  // namespace oriel
