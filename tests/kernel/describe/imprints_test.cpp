#include "kernel/segment/flush/imprints.h"

#include "tests/support/described.h"
#include "tests/support/flush.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Described;

Described with_imprints(Building building) {
  Described d{test::segmented(std::move(building)), {}};
  auto& [of, solid, segmentation] = d.segmented;
  add_imprints(of, solid, segmentation);
  d.description = describe(of, segmentation);
  return d;
}

/// The block with recesses, one of which gets a flush twin.
Building recess_and_twin() {
  Building building = test::in_whole_facets(
      test::BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 1}, {3.25, 0.125, 2.5}).build());
  test::add_pane(building, 4, 1, 5.25, 2.5);
  return building;
}

TEST_SUITE("kernel/describe") {
  TEST_CASE("the recess of an opening is where its pane is and not its frame") {
    // A frame of a tenth in the plane of the wall, the sashes 4 cm behind it.
    const Described d = with_imprints(test::block_with_sashes());
    const FeatureId frame = d.at({2, 0, 1}, {4, 0.04, 2.5});
    test::check_numbers(d, frame, {{"recess", 0.04}});
    const FeatureId sash = d.at({2.125, 0, 1.125}, {2.875, 0.04, 2.375});
    test::check_numbers(d, sash, {{"recess", 0.04}});
    CHECK(holds(d, "inside", sash, frame));
    CHECK_FALSE(holds(d, "inside", frame, sash));
    const Described twin = with_imprints(recess_and_twin());
    test::check_numbers(twin, twin.at({4, 0, 1}, {5.25, 0, 2.5}), {{"recess", 0}});
    test::check_numbers(twin, twin.at({2, 0, 1}, {3.25, 0.125, 2.5}), {{"recess", 0.125}});
  }

  TEST_CASE("an imprint has the attributes of an opening and no depth") {
    const Described d = with_imprints(recess_and_twin());
    const FeatureId pane = d.at({4, 0, 1}, {5.25, 0, 2.5});
    test::check_numbers(d, pane,
                        {{"a", 1.5},
                         {"b", 1.25},
                         {"silhouette", 1.875},
                         {"width", 1.25},
                         {"height", 1.5},
                         {"new_area", 1.875},
                         {"surface", 1.875},
                         {"inclination", 90},
                         {"azimuth", 180},
                         {"base_height", 1},
                         {"top", 2.5},
                         {"below_ridge", 3.5},
                         {"edge_gap", 1},
                         {"host_inclination", 90},
                         {"growth_out", 0}});
    // Exactly nothing, and not the dust of doubles.
    for (const char* name : {"depth", "c", "volume", "split_order"}) {
      CAPTURE(std::string(name));
      CHECK(d.number(pane, name) == 0);
    }
    for (const char* name : {"value", "quality", "old_area"}) {
      CAPTURE(std::string(name));
      CHECK_FALSE(d.has(pane, name));
    }
  }

  TEST_CASE("a turned imprint has no depth either") {
    Building building = recess_and_twin();
    for (Vec3& p : building.vertices) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
    const Described d = with_imprints(std::move(building));
    for (int i = 0; i < 2; ++i)
      if (d.segmented.segmentation.features[static_cast<std::size_t>(i)].sense == Sense::imprint)
        for (const char* name : {"depth", "c"}) CHECK(d.number(FeatureId{i}, name) == 0);
  }

  TEST_CASE("an imprint and a recess of its size are alike and count together") {
    const Described d = with_imprints(recess_and_twin());
    const FeatureId pane = d.at({4, 0, 1}, {5.25, 0, 2.5});
    const FeatureId recess = d.at({2, 0, 1}, {3.25, 0.125, 2.5});
    for (const char* name : {"alike", "beside", "same_facade", "same_storey"}) {
      CAPTURE(std::string(name));
      CHECK(holds(d, name, pane, recess));
      CHECK(holds(d, name, recess, pane));
    }
    for (const FeatureId id : {pane, recess})
      test::check_numbers(d, id, {{"per_facade", 2}, {"per_storey", 2}, {"storey", 0}});
  }

  TEST_CASE("sashes lie in their frame and not on its facade") {
    Building building = test::block_with_sashes();
    test::add_pane(building, 6, 1, 8, 2.5);
    const Described d = with_imprints(std::move(building));
    const FeatureId frame = d.at({2, 0, 1}, {4, 0.04, 2.5}), twin = d.at({6, 0, 1}, {8, 0, 2.5});
    const FeatureId left = d.at({2.125, 0, 1.125}, {2.875, 0.04, 2.375});
    const FeatureId right = d.at({3.125, 0, 1.125}, {3.875, 0.04, 2.375});
    for (const FeatureId sash : {left, right}) {
      CHECK(holds(d, "host", sash, frame));
      CHECK(holds(d, "contains", frame, sash));
      CHECK_FALSE(holds(d, "same_facade", sash, frame));
      CHECK(d.number(sash, "per_facade") == 2);
    }
    CHECK(holds(d, "alike", left, right));
    CHECK(holds(d, "alike", frame, twin));
    CHECK(d.number(frame, "per_facade") == 2);
    CHECK(std::abs(d.number(frame, "depth") - 0.04) < 1e-5);
  }

  TEST_CASE("imprints have ids of their own") {
    Building building = test::plain_block();
    const int frame = test::add_pane(building, 2, 1, 4, 2.5);
    test::add_pane(building, 2.25, 1.25, 3.75, 2.25, frame);
    const Described d = with_imprints(std::move(building));
    CHECK(d.table().id(FeatureId{0}) != d.table().id(FeatureId{1}));
  }
}

}  // namespace
}  // namespace oriel
