#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::outcome_of;
using test::solid_of;

/// A box of six polygons, each with vertices of its own.
Building loose_box() {
  Building box = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
  Building loose = box;
  loose.vertices.clear();
  for (Polygon& polygon : loose.polygons)
    for (int& v : polygon.rings[0]) {
      loose.vertices.push_back(box.vertices[static_cast<std::size_t>(v)]);
      v = static_cast<int>(loose.vertices.size()) - 1;
    }
  return loose;
}

/// A box with a pocket in its top, whose ring is given as the rings of the top polygon.
Building pocket_box(const std::vector<std::vector<Vec3>>& top) {
  std::vector<std::vector<Vec3>> polygons{
      {{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}}, {{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}},
      {{4, 0, 0}, {4, 4, 0}, {4, 4, 2}, {4, 0, 2}}, {{4, 4, 0}, {0, 4, 0}, {0, 4, 2}, {4, 4, 2}},
      {{0, 4, 0}, {0, 0, 0}, {0, 0, 2}, {0, 4, 2}}, {{1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}},
      {{1, 1, 1}, {1, 1, 2}, {2, 1, 2}, {2, 1, 1}}, {{2, 1, 1}, {2, 1, 2}, {2, 2, 2}, {2, 2, 1}},
      {{2, 2, 1}, {2, 2, 2}, {1, 2, 2}, {1, 2, 1}}, {{1, 2, 1}, {1, 2, 2}, {1, 1, 2}, {1, 1, 1}}};
  const std::size_t first = polygons.size();
  polygons.insert(polygons.end(), top.begin(), top.end());
  Building building = test::building_of(polygons);
  for (std::size_t i = first + 1; i < polygons.size(); ++i)
    building.polygons[first].rings.push_back(building.polygons[i].rings[0]);
  building.polygons.resize(first + 1);
  return building;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("vertices within the weld distance are one and vertices beyond it are not") {
    CHECK(outcome_of(loose_box()) == "solid");
    CHECK(solid_of(test::with_noise(loose_box(), 0.0002, 1)).vertices.size() == 8);
    Building apart = loose_box();
    apart.vertices[0] = apart.vertices[0] + Vec3{0.005, 0, 0};
    CHECK(outcome_of(apart) == "solid E317");  // on an edge beside it: a T-vertex
    Building off = loose_box();
    off.vertices[0] = off.vertices[0] + Vec3{0.005, 0.005, 0.005};
    CHECK(outcome_of(off, {}, {Closing::none, 0}) == "E302");
    Tolerances coarse;
    coarse.weld_m = 0.01;
    coarse.plane_offset_m = 0.01;
    CHECK(solid_of(apart, coarse).vertices.size() == 8);
  }

  TEST_CASE("polygons that are turned the wrong way are turned round with a warning") {
    for (std::size_t wrong = 0; wrong < 6; ++wrong) {
      Building building = loose_box();
      std::ranges::reverse(building.polygons[wrong].rings[0]);
      CHECK(outcome_of(building) == "solid E308");
      CHECK(volume_m3(solid_of(building)) == doctest::Approx(60).epsilon(1e-12));
    }
  }

  TEST_CASE("a solid inside out is turned round with a warning") {
    Building building = loose_box();
    for (Polygon& polygon : building.polygons) std::ranges::reverse(polygon.rings[0]);
    CHECK(outcome_of(building) == "solid E308");
    const Solid solid = solid_of(building);
    CHECK(volume_m3(solid) == doctest::Approx(60).epsilon(1e-12));
    CHECK_FALSE(solid.shells.at(0).is_cavity);
    CHECK(solid.planes.size() == 6);
  }

  TEST_CASE("polygons that vanish by welding are dropped with a note") {
    Building building = loose_box();
    Polygon sliver = building.polygons[0];
    sliver.source = static_cast<int>(building.polygons.size());
    sliver.rings = {{sliver.rings[0][0], sliver.rings[0][1], sliver.rings[0][0]}};
    building.polygons.push_back(sliver);
    CHECK(outcome_of(building) == "solid E304");
    CHECK(solid_of(building).facets.size() == 6);
  }

  TEST_CASE("a repeated vertex in a ring changes nothing") {
    Building building = loose_box();
    auto& ring = building.polygons[2].rings[0];
    ring.insert(ring.begin() + 1, ring[1]);
    ring.push_back(ring.front());
    CHECK(outcome_of(building) == "solid");
    CHECK(solid_of(building).vertices.size() == 8);
  }

  TEST_CASE("a hole given as inner ring or tied to the outer ring by a bridge is the same solid") {
    const std::vector<std::vector<Vec3>> with_ring{{{0, 0, 2}, {4, 0, 2}, {4, 4, 2}, {0, 4, 2}},
                                                   {{1, 1, 2}, {1, 2, 2}, {2, 2, 2}, {2, 1, 2}}};
    const std::vector<std::vector<Vec3>> keyhole{{{0, 0, 2},
                                                  {4, 0, 2},
                                                  {4, 4, 2},
                                                  {0, 4, 2},
                                                  {0, 0, 2},
                                                  {1, 1, 2},
                                                  {1, 2, 2},
                                                  {2, 2, 2},
                                                  {2, 1, 2},
                                                  {1, 1, 2}}};
    const Solid one = solid_of(pocket_box(with_ring)), other = solid_of(pocket_box(keyhole));
    for (const Solid* solid : {&one, &other}) {
      CHECK(solid->facets.size() == 11);
      CHECK(volume_m3(*solid) == doctest::Approx(31).epsilon(1e-12));
      CHECK(std::ranges::count_if(solid->facets,
                                  [](const Facet& f) { return f.loops.size() == 2; }) == 1);
    }
    CHECK(surface_m2(one) == doctest::Approx(surface_m2(other)).epsilon(1e-12));
  }

  TEST_CASE("a ring that touches itself at a vertex is cut into simple rings") {
    // Two boxes that meet in a vertical edge, floor and roof each as one ring through that edge.
    const Building building = test::building_of(
        {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}, {1, 0, 0}},
         {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {2, 1, 1}, {2, 2, 1}, {1, 2, 1}, {1, 1, 1}, {0, 1, 1}},
         {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
         {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}},
         {{1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}},
         {{0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}},
         {{1, 1, 0}, {2, 1, 0}, {2, 1, 1}, {1, 1, 1}},
         {{2, 1, 0}, {2, 2, 0}, {2, 2, 1}, {2, 1, 1}},
         {{2, 2, 0}, {1, 2, 0}, {1, 2, 1}, {2, 2, 1}},
         {{1, 2, 0}, {1, 1, 0}, {1, 1, 1}, {1, 2, 1}}});
    const Solid solid = solid_of(building);
    CHECK(volume_m3(solid) == doctest::Approx(2).epsilon(1e-12));
    CHECK(surface_m2(solid) == doctest::Approx(12).epsilon(1e-12));
  }

  TEST_CASE("a recess thinner than the weld distance leaves the wall whole") {
    const Building building =
        BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, 0, 1}, {2, 0.0005, 2}).build();
    CHECK(outcome_of(building) == "solid E304");
    CHECK(solid_of(building).facets.size() == 6);
  }

  TEST_CASE("a recess or a rise thinner than the plane tolerance is swallowed with a warning") {
    const Building recess =
        BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, 0, 1}, {2, 0.0015, 2}).build();
    const Building rise =
        BoxBody().add({0, 0, 0}, {4, 4, 4}).add({1, 1, 4}, {2, 2, 4.0015}).build();
    for (const Building& building : {recess, rise}) {
      CHECK(outcome_of(building) == "solid E309");
      const Solid solid = solid_of(building);
      CHECK(solid.facets.size() == 6);
      CHECK(solid.vertices.size() == 8);
      CHECK(volume_m3(solid) == doctest::Approx(64).epsilon(1e-12));
    }
  }

  TEST_CASE("a fin thinner than the plane tolerance leaves no facets back to back") {
    const Building fin = BoxBody().add({0, 0, 0}, {4, 4, 4}).add({4, 1, 1}, {6, 3, 1.0015}).build();
    CHECK(outcome_of(fin) == "solid E309");
    CHECK(solid_of(fin).facets.size() == 6);
    CHECK(volume_m3(solid_of(fin)) == doctest::Approx(64).epsilon(1e-12));
  }

  TEST_CASE("a recess deeper than the tolerance keeps its depth") {
    const Building building =
        BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, 0, 1}, {2, 0.02, 2}).build();
    CHECK(outcome_of(building) == "solid");
    CHECK(solid_of(building).facets.size() == 11);
    CHECK(volume_m3(solid_of(building)) == doctest::Approx(64 - 0.02).epsilon(1e-6));
    Tolerances coarse;
    coarse.weld_m = 0.01;
    coarse.plane_offset_m = 0.03;
    CHECK(outcome_of(building, coarse) == "solid E309");
    CHECK(solid_of(building, coarse).facets.size() == 6);
  }
}

}  // namespace
}  // namespace oriel
