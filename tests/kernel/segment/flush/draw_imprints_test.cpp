#include "kernel/segment/flush/draw_imprints.h"

#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/remove.h"
#include "tests/support/corpus.h"
#include "tests/support/flush.h"
#include "tests/support/segmented.h"

#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::features_of;
using test::Segmented;

Segmented with_imprint_features(Building building) {
  Segmented s = test::segmented(std::move(building));
  add_imprints(s.building, s.solid, s.segmentation);
  return s;
}

Solid drawn(const Segmented& s) {
  return draw_imprints(s.solid, s.segmentation, features_of(s.segmentation, Sense::imprint));
}

/// The only facet that names the polygon.
const Facet& facet_of(const Solid& solid, int polygon) {
  const Facet* found = nullptr;
  for (const Facet& facet : solid.facets)
    if (std::ranges::binary_search(facet.polygons, polygon)) {
      CHECK(found == nullptr);
      found = &facet;
    }
  REQUIRE(found != nullptr);
  return *found;
}

double area_of(const Solid& solid, const Facet& facet) {
  return area_m2(solid.vertices, facet, solid.planes[facet.plane.index()].normal);
}

void check_same_body(const Solid& solid, const Solid& was) {
  CHECK(is_closed(solid));
  CHECK(volume_m3(solid) == doctest::Approx(volume_m3(was)).epsilon(1e-6));
  CHECK(surface_m2(solid) == doctest::Approx(surface_m2(was)).epsilon(1e-6));
  std::size_t in_shells = 0;
  for (const Shell& shell : solid.shells) in_shells += shell.facets.size();
  CHECK(in_shells == solid.facets.size());
  for (const Facet& facet : solid.facets) CHECK(area_of(solid, facet) > 0);
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a pane gets a facet and its wall a hole") {
    Building building = test::plain_block();
    const int pane = test::add_pane(building, 2, 1, 3, 2.25);
    const Segmented s = with_imprint_features(std::move(building));
    REQUIRE(s.solid.facets.size() == 6);
    const Solid solid = drawn(s);
    check_same_body(solid, s.solid);
    CHECK(solid.facets.size() == 7);
    CHECK(facet_of(solid, pane).polygons == std::vector{pane});
    CHECK(area_of(solid, facet_of(solid, pane)) == doctest::Approx(1.25).epsilon(1e-9));
  }

  TEST_CASE("a door that meets the edge of its wall gets a facet and the ground its corners") {
    const Segmented s = with_imprint_features(test::block_with_door());
    REQUIRE(s.solid.facets.size() == 6);
    const Solid solid = drawn(s);
    check_same_body(solid, s.solid);
    CHECK(solid.facets.size() == 7);
    CHECK(area_of(solid, facet_of(solid, 6)) == doctest::Approx(2).epsilon(1e-9));
    CHECK(facet_of(solid, 0).loops.size() == 1);
    CHECK(facet_of(solid, 0).loops[0].size() == 8);
    CHECK(facet_of(solid, 5).loops[0].size() == 6);
  }

  TEST_CASE("a door as high as its wall parts it") {
    const Segmented s = with_imprint_features(
        test::building_of({{{0, 0, 0}, {4, 0, 0}, {4, 0, 6}, {0, 0, 6}},
                           {{5, 0, 0}, {10, 0, 0}, {10, 0, 6}, {5, 0, 6}},
                           {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, {10, 0, 6}},
                           {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}},
                           {{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}},
                           {{4, 0, 6}, {5, 0, 6}, {10, 0, 6}, {10, 8, 6}, {0, 8, 6}, {0, 0, 6}},
                           {{0, 8, 0}, {10, 8, 0}, {10, 0, 0}, {5, 0, 0}, {4, 0, 0}, {0, 0, 0}},
                           {{4, 0, 0}, {5, 0, 0}, {5, 0, 6}, {4, 0, 6}}}));
    CHECK(features_of(s.segmentation, Sense::imprint).empty());
    // Drawn all the same: what it is called does not matter here.
    Segmentation as_if = s.segmentation;
    Feature door;
    door.sense = Sense::imprint;
    for (const Plane& plane : as_if.planes)
      if (plane.normal == Vec3{0, -1, 0})
        door.planes = {PlaneId{static_cast<int>(&plane - as_if.planes.data())}};
    for (const Vec3 p : {Vec3{4, 0, 0}, {5, 0, 0}, {5, 0, 6}, {4, 0, 6}}) {
      door.outline.push_back(static_cast<int>(as_if.vertices.size()));
      as_if.vertices.push_back({p, false});
    }
    door.cap_point = {4.5, 0, 3};
    door.source_polygons = {7};
    as_if.features.push_back(door);
    const Solid solid = draw_imprints(s.solid, as_if, {FeatureId{0}});
    check_same_body(solid, s.solid);
    CHECK(solid.facets.size() == 8);
  }

  TEST_CASE("a frame and the pane in it and sashes are all drawn") {
    Building building = test::block_with_sashes();
    const int frame = test::add_pane(building, 6, 1, 9, 3);
    const int pane = test::add_pane(building, 6.25, 1.25, 8.75, 2.75, frame);
    const Segmented s = with_imprint_features(std::move(building));
    const Solid solid = drawn(s);
    check_same_body(solid, s.solid);
    CHECK(solid.facets.size() == s.solid.facets.size() + 3);
    CHECK(area_of(solid, facet_of(solid, frame)) == doctest::Approx(6 - 2.5 * 1.5).epsilon(1e-6));
    CHECK(area_of(solid, facet_of(solid, pane)) == doctest::Approx(2.5 * 1.5).epsilon(1e-6));
    const Facet& with_sashes = facet_of(solid, 16);
    CHECK(with_sashes.loops.size() == 3);
  }

  TEST_CASE("panes that touch in their corners leave rings that touch in points only") {
    Building building = test::plain_block();
    test::add_pane(building, 2, 1, 3, 2);
    test::add_pane(building, 3, 2, 4, 3);
    test::add_pane(building, 4, 1, 5, 2);
    const Segmented s = with_imprint_features(std::move(building));
    const Solid solid = drawn(s);
    check_same_body(solid, s.solid);
    CHECK(solid.facets.size() == 9);
    for (const Facet& facet : solid.facets) {
      CHECK(area_of(solid, {facet.plane, {facet.loops[0]}, {}}) > 0);
      for (const Loop& loop : facet.loops)
        CHECK(std::set<int>(loop.begin(), loop.end()).size() == loop.size());
    }
    CHECK(std::ranges::count(solid.facets, std::size_t{4},
                             [](const Facet& facet) { return facet.loops.size(); }) == 1);
  }

  TEST_CASE("an outline that crosses itself or runs the other way is not drawn") {
    Building building = test::plain_block();
    const int pane = test::add_pane(building, 2, 1, 3, 2);
    const Segmented s = with_imprint_features(std::move(building));
    const FeatureId id = features_of(s.segmentation, Sense::imprint).at(0);
    const auto facets_with = [&](const std::vector<Vec3>& outline) {
      Segmentation as_if = s.segmentation;
      Feature& imprint = as_if.features[id.index()];
      imprint.outline.clear();
      for (const Vec3 p : outline) {
        imprint.outline.push_back(static_cast<int>(as_if.vertices.size()));
        as_if.vertices.push_back({p, false});
      }
      const Solid solid = draw_imprints(s.solid, as_if, {id});
      check_same_body(solid, s.solid);
      return solid.facets.size();
    };
    CHECK(pane == 6);
    CHECK(facets_with({{2, 0, 1}, {3, 0, 1}, {3, 0, 2}, {2, 0, 2}}) == 7);
    CHECK(facets_with({{2, 0, 2}, {3, 0, 2}, {3, 0, 1}, {2, 0, 1}}) == 6);
    CHECK(facets_with({{2, 0, 1}, {3, 0, 1}, {2, 0, 2}, {4, 0, 3}}) == 6);
  }

  TEST_CASE("an outline that runs across a recess of its facet is not drawn") {
    Segmented s = with_imprint_features(test::block_with_sashes());
    const FeatureId frame = features_of(s.segmentation, Sense::imprint).at(0);
    Feature& imprint = s.segmentation.features[frame.index()];
    imprint.outline.clear();
    for (const Vec3 p : {Vec3{1, 0, 1.5}, {3, 0, 1.5}, {3, 0, 2}, {1, 0, 2}}) {
      imprint.outline.push_back(static_cast<int>(s.segmentation.vertices.size()));
      s.segmentation.vertices.push_back({p, false});
    }
    CHECK(drawn(s).facets.size() == s.solid.facets.size());
  }

  TEST_CASE("every imprint of the samples is drawn") {
    std::size_t imprints = 0;
    for (const Building& building : test::samples().buildings) {
      CAPTURE(building.id);
      const Segmented s = with_imprint_features(building);
      const Solid solid = drawn(s);
      check_same_body(solid, s.solid);
      const std::size_t count = features_of(s.segmentation, Sense::imprint).size();
      CHECK(solid.facets.size() == s.solid.facets.size() + count);
      imprints += count;
    }
    CHECK(imprints > 15);
  }

  TEST_CASE("an imprint whose facet is gone is not drawn") {
    Building building = test::plain_block();
    test::add_pane(building, 2, 1, 3, 2.25);
    Segmented s = with_imprint_features(std::move(building));
    const Solid other = test::solid_of(test::BoxBody().add({20, 5, 0}, {30, 8, 6}).build());
    const Solid solid = draw_imprints(other, s.segmentation, {FeatureId{0}});
    CHECK(solid.facets.size() == other.facets.size());
  }

  TEST_CASE("an imprint comes off without a cut and its sashes with it") {
    const Segmented s = with_imprint_features(test::block_with_sashes());
    const auto frames = features_of(s.segmentation, Sense::imprint);
    REQUIRE(frames.size() == 1);
    const Remainder rest = remove_features(s.solid, s.segmentation, frames);
    CHECK(rest.refused.empty());
    CHECK(rest.removed.size() == 3);
    CHECK(is_closed(rest.solid));
    CHECK(rest.solid.facets.size() == 6);
    CHECK(volume_m3(rest.solid) == doctest::Approx(480).epsilon(1e-9));
    for (const Facet& facet : rest.solid.facets)
      for (const int polygon : facet.polygons)
        CHECK_FALSE(std::ranges::binary_search(
            s.segmentation.features[frames[0].index()].source_polygons, polygon));
    // A sash alone comes off without its frame.
    const Remainder without_sash = remove_features(s.solid, s.segmentation, {FeatureId{0}});
    CHECK(without_sash.removed == std::vector{FeatureId{0}});
    CHECK(is_closed(without_sash.solid));
  }

  TEST_CASE("an imprint whose sash cannot go stays and the sash stays") {
    Segmented s = with_imprint_features(test::block_with_sashes());
    const auto frames = features_of(s.segmentation, Sense::imprint);
    // A cut that is not found any more.
    s.segmentation.features[0].cap_point = {8, 0, 5};
    const Remainder rest = remove_features(s.solid, s.segmentation, frames);
    CHECK(rest.removed.empty());
    REQUIRE(rest.refused.size() == 2);
    for (const Refusal& refusal : rest.refused) CHECK_FALSE(refusal.reason.empty());
    CHECK(volume_m3(rest.solid) == doctest::Approx(volume_m3(s.solid)).epsilon(1e-9));
  }
}

}  // namespace
}  // namespace oriel
