#include "tests/kernel/segment/invariants.h"
#include "tests/support/changed.h"
#include "tests/support/houses.h"
#include "tests/support/near.h"
#include "tests/support/segmented.h"

#include <numbers>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::feature_in;
using test::features_of;
using test::near;
using test::Segmented;
using test::splits_of;

Segmented natural(Building building) {
  return test::segmented(std::move(building), Order::natural);
}

Vec3 normal_of(const Segmentation& s, PlaneId plane) { return s.planes[plane.index()].normal; }

TEST_SUITE("kernel/segment") {
  TEST_CASE("the house of the paper has the same leaves and nodes in the natural order") {
    const Segmented s = natural(test::full_house());
    CHECK(s.segmentation.stats.leaves == 19);
    CHECK(s.segmentation.stats.inner == 8);
    CHECK(features_of(s.segmentation, Sense::hole).size() == 16);
    CHECK(features_of(s.segmentation, Sense::protrusion).size() == 2);
    CHECK(feature_in(s.segmentation, {4, 8, 3}, {8, 9.5, 3.2}).is_valid());
    for (const Feature& f : s.segmentation.features) CHECK(f.is_natural);
  }

  TEST_CASE("a ridge chimney is one part of two planes worth 3/797") {
    const Segmented s = natural(test::ridge_chimney());
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& chimney = s.segmentation.features[0];
    CHECK(chimney.sense == Sense::protrusion);
    CHECK(chimney.planes.size() == 2);
    CHECK(*chimney.value == near(3.0 / 797));
    CHECK(chimney.is_natural);
    REQUIRE(s.segmentation.cells.size() == 2);
    CHECK(s.segmentation.cells[1].flag == LeafFlag::own);
    CHECK_FALSE(s.segmentation.cells[1].is_convex);
  }

  TEST_CASE("the shorter wing of an L is cut for 1/2") {
    const Segmented s = natural(test::l_house());
    REQUIRE(s.segmentation.features.size() == 1);
    CHECK(*s.segmentation.features[0].value == near(0.5));
    CHECK(s.segmentation.features[0].volume_m3 == near(144));
  }

  TEST_CASE("a wing with a gable as high as the ridge is one part of two planes worth 17/27") {
    const Segmented s = natural(test::cross_gable());
    REQUIRE(s.segmentation.features.size() == 1);
    CHECK(s.segmentation.features[0].planes.size() == 2);
    CHECK(*s.segmentation.features[0].value == near(17.0 / 27));
    CHECK(s.segmentation.features[0].volume_m3 == near(282));
  }

  TEST_CASE("a door on the ground is a hole of two planes whose first is the wall") {
    const Segmented s = natural(test::house_with_door());
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& door = s.segmentation.features[0];
    CHECK(door.sense == Sense::hole);
    REQUIRE(door.planes.size() == 2);
    CHECK(normal_of(s.segmentation, door.planes[0]) == Vec3{0, -1, 0});
    CHECK(normal_of(s.segmentation, door.planes[1]) == Vec3{0, 0, -1});
    CHECK(door.new_area_m2 == near(2.1 + 0.3));
    CHECK(door.is_natural);
  }

  TEST_CASE("a dormer comes off with its window and the window larger than its frame is kept") {
    const Segmented s = natural(test::dormer_with_window());
    REQUIRE(s.segmentation.features.size() == 2);
    const Feature &dormer = s.segmentation.features[0], &window = s.segmentation.features[1];
    CHECK(dormer.sense == Sense::protrusion);
    CHECK(dormer.planes.size() == 1);
    CHECK_FALSE(dormer.parent.is_valid());
    CHECK(window.sense == Sense::hole);
    CHECK(window.parent == FeatureId{0});
    CHECK(window.host == FeatureId{0});
    CHECK(*window.quality == near(1.44 / 2.01));
    CHECK(*window.value == near(1.44 / (1.44 + 2.01)));
  }

  TEST_CASE("a chimney keeps the head that is wider than its shaft") {
    const Segmented s = natural(test::chimney_with_head());
    const FeatureId chimney = feature_in(s.segmentation, {3.9, 2.9, 6}, {4.7, 3.7, 7.8});
    REQUIRE(chimney.is_valid());
    const Feature& f = s.segmentation.features[chimney.index()];
    CHECK_FALSE(f.parent.is_valid());
    CHECK(f.volume_m3 == near(0.36 * 1.5 + 0.64 * 0.3));
    for (const Feature& other : s.segmentation.features)
      if (&other != &f) CHECK(other.parent == chimney);
  }

  TEST_CASE("a ridge chimney keeps its head too") {
    const Segmented s = natural(test::ConvexBody()
                                    .add(test::gable())
                                    .add(test::box({5, 3.7, 5}, {5.6, 4.3, 10.5}))
                                    .add(test::box({4.9, 3.6, 10.5}, {5.7, 4.4, 11}))
                                    .build());
    REQUIRE_FALSE(s.segmentation.features.empty());
    const Feature& chimney = s.segmentation.features[0];
    CHECK(chimney.planes.size() == 2);
    CHECK(chimney.box.max.z == near(11));
    CHECK(chimney.box.max.x - chimney.box.min.x == near(0.8));
  }

  TEST_CASE("a balcony is one feature with its hollow or its parapet inside") {
    const Segmented s = natural(test::balcony());
    const FeatureId balcony = feature_in(s.segmentation, {3, -1.5, 3}, {7, 0, 4});
    REQUIRE(balcony.is_valid());
    CHECK_FALSE(s.segmentation.features[balcony.index()].parent.is_valid());
    for (const FeatureId id : test::all_features(s.segmentation))
      if (id != balcony) CHECK(s.segmentation.features[id.index()].parent.is_valid());
  }

  TEST_CASE("a passage is a hole of three planes") {
    const Segmented s = natural(test::passage());
    REQUIRE(s.segmentation.features.size() == 1);
    CHECK(s.segmentation.features[0].sense == Sense::hole);
    CHECK(s.segmentation.features[0].planes.size() == 3);
    CHECK(s.segmentation.features[0].volume_m3 == near(48));
  }

  TEST_CASE("a cut that leaves two lumps gives its node a rest of two") {
    // A beam across two blocks.
    for (const Order order : {Order::natural, Order::paper}) {
      const Segmented s = test::segmented(test::BoxBody()
                                              .add({0, 0, 0}, {4, 2, 1})
                                              .add({6, 0, 0}, {10, 2, 1})
                                              .add({3, 0.5, 1}, {7, 1.5, 2})
                                              .build(),
                                          order);
      const CsgNode& root = s.segmentation.nodes[s.segmentation.root.index()];
      CHECK(root.kind == CsgNode::Kind::unite);
      CHECK(root.rest.size() == 2);
      CHECK(root.parts.size() == 1);
      CHECK(*root.quality == near(1.0 / 7));
      test::check_segmentation(s);
    }
  }

  TEST_CASE("a door level with the floor of its loggia is a hole of its own") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {10, 8, 6})
                                    .remove({3, 0, 3}, {6, 1.3, 5})
                                    .remove({4, 1.3, 3}, {5, 1.4, 5})
                                    .build());
    const FeatureId loggia = feature_in(s.segmentation, {3, 0, 3}, {6, 1.4, 5});
    const FeatureId door = feature_in(s.segmentation, {4, 1.3, 3}, {5, 1.4, 5});
    REQUIRE(loggia.is_valid());
    REQUIRE(door.is_valid());
    const Feature& f = s.segmentation.features[door.index()];
    CHECK(f.sense == Sense::hole);
    CHECK(f.is_natural);
    CHECK(f.parent == loggia);
    CHECK(f.host == loggia);
    CHECK(f.planes.size() == 1);
    test::check_segmentation(s);
  }

  TEST_CASE("a door level with a slab before it and the slab are two features") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {10, 8, 6})
                                    .add({3, -1.5, 2.8}, {7, 0, 3})
                                    .remove({4, 0, 3}, {5, 0.2, 5})
                                    .build());
    REQUIRE(s.segmentation.features.size() == 2);
    CHECK(feature_in(s.segmentation, {3, -1.5, 2.8}, {7, 0, 3}).is_valid());
    CHECK(feature_in(s.segmentation, {4, 0, 3}, {5, 0.2, 5}).is_valid());
    for (const Feature& f : s.segmentation.features) {
      CHECK(f.is_natural);
      CHECK_FALSE(f.parent.is_valid());
    }
    test::check_segmentation(s);
  }

  TEST_CASE("a chimney flush with a wall comes off at the roof through the neck of the wall") {
    const Segmented s = natural(
        test::ConvexBody().add(test::gable()).add(test::box({0, 1.6, 6}, {0.6, 2.2, 10})).build());
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& chimney = s.segmentation.features[0];
    CHECK(chimney.sense == Sense::protrusion);
    CHECK(chimney.is_natural);
    CHECK(chimney.box.max.z == near(10));
    CHECK(s.segmentation.cells.size() == 2);
    test::check_segmentation(s);
  }

  TEST_CASE("a house stays the body under a flat roof that is wider, and the roof is the part") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {10, 8, 6})
                                    .add({-0.5, -0.5, 6}, {10.5, 8.5, 6.3})
                                    .remove({2, 0, 2}, {3, 0.2, 4})
                                    .build());
    REQUIRE(s.segmentation.features.size() == 2);
    const FeatureId roof = feature_in(s.segmentation, {-0.5, -0.5, 6}, {10.5, 8.5, 6.3});
    const FeatureId window = feature_in(s.segmentation, {2, 0, 2}, {3, 0.2, 4});
    REQUIRE(roof.is_valid());
    REQUIRE(window.is_valid());
    const Feature& f = s.segmentation.features[roof.index()];
    CHECK(f.sense == Sense::protrusion);
    REQUIRE(f.planes.size() == 1);
    CHECK(normal_of(s.segmentation, f.planes[0]) == Vec3{0, 0, 1});
    CHECK(f.new_area_m2 == near(80));
    CHECK_FALSE(f.host.is_valid());
    CHECK_FALSE(s.segmentation.features[window.index()].parent.is_valid());
    CHECK_FALSE(s.segmentation.features[window.index()].host.is_valid());
    test::check_segmentation(s);
  }

  TEST_CASE("a house stays the body under the wide heads of two chimneys in one plane") {
    // Heads that are cut before their shafts: one of the shafts leans on a wall over the roof.
    test::ConvexBody body;
    body.add(test::gable());
    for (const double x : {2.0, 7.0}) {
      body.add(test::box({x, 3.6, 5}, {x + 0.8, 4.4, 11}));
      body.add(test::box({x - 0.05, 3.55, 11}, {x + 0.85, 4.45, 11.15}));
    }
    const Segmented s = natural(body.build());
    const double whole_m3 = volume_m3(s.solid);
    std::size_t heads = 0;
    for (const Feature& f : s.segmentation.features) {
      CHECK(f.volume_m3 < 0.1 * whole_m3);
      heads += f.box.max.z == near(11.15) && f.box.max.x - f.box.min.x == near(0.9) ? 1U : 0U;
    }
    CHECK(heads >= 2);
    test::check_segmentation(s);
  }

  TEST_CASE("a canopy holds the posts under it, and a slab of roof nothing that stands on it") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {10, 8, 6})
                                    .add({3, -1.2, 2.6}, {5, 0, 2.75})
                                    .add({3, -1.2, 0}, {3.15, -1.05, 2.6})
                                    .add({4.85, -1.2, 0}, {5, -1.05, 2.6})
                                    .build());
    CHECK(feature_in(s.segmentation, {3, -1.2, 0}, {5, 0, 2.75}).is_valid());
    test::check_segmentation(s);
    const Segmented roof = natural(test::BoxBody()
                                       .add({0, 0, 0}, {10, 8, 6})
                                       .add({-0.5, -0.5, 6}, {10.5, 8.5, 6.3})
                                       .add({2, 2, 6.3}, {2.6, 2.6, 7.5})
                                       .build());
    CHECK(feature_in(roof.segmentation, {-0.5, -0.5, 6}, {10.5, 8.5, 6.3}).is_valid());
    CHECK(feature_in(roof.segmentation, {2, 2, 6.3}, {2.6, 2.6, 7.5}).is_valid());
    test::check_segmentation(roof);
  }

  TEST_CASE("a bay that a plinth runs into is a feature of its own") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {24, 8, 6})
                                    .add({0, -0.1, 0}, {24, 0, 0.5})
                                    .add({4, -1, 0}, {7, 0, 3})
                                    .build());
    REQUIRE(s.segmentation.features.size() == 2);
    const FeatureId bay = feature_in(s.segmentation, {4, -1, 0}, {7, 0, 3});
    const FeatureId plinth = feature_in(s.segmentation, {0, -0.1, 0}, {24, 0, 0.5});
    REQUIRE(bay.is_valid());
    REQUIRE(plinth.is_valid());
    const Feature& f = s.segmentation.features[bay.index()];
    CHECK(f.is_natural);
    CHECK_FALSE(f.parent.is_valid());
    REQUIRE(f.planes.size() == 3);
    CHECK(normal_of(s.segmentation, f.planes[0]) == Vec3{0, -1, 0});
    test::check_segmentation(s);
  }

  TEST_CASE("stairs before a plinth that is higher are a feature of their own") {
    const Segmented s = natural(test::BoxBody()
                                    .add({0, 0, 0}, {24, 8, 6})
                                    .add({0, -0.1, 0}, {24, 0, 0.6})
                                    .add({4, -0.6, 0}, {7, -0.1, 0.4})
                                    .add({4, -1.1, 0}, {7, -0.6, 0.2})
                                    .build());
    CHECK(feature_in(s.segmentation, {4, -1.1, 0}, {7, -0.1, 0.4}).is_valid());
    CHECK(feature_in(s.segmentation, {0, -0.1, 0}, {24, 0, 0.6}).is_valid());
    test::check_segmentation(s);
  }

  TEST_CASE("a chimney flush with a gable and astride the ridge is one part") {
    const Segmented s = natural(test::ConvexBody()
                                    .add(test::gable())
                                    .add(test::box({0, 3.7, 6}, {0.6, 4.3, 10.5}))
                                    .build());
    REQUIRE(s.segmentation.features.size() == 1);
    CHECK(s.segmentation.features[0].is_natural);
    CHECK(s.segmentation.features[0].box.max.z == near(10.5));
    CHECK(s.segmentation.features[0].volume_m3 == near(0.6 * 0.6 * 1.5 + 0.6 * 0.3 * 0.3 * 0.75));
    test::check_segmentation(s);
  }

  TEST_CASE("a hole goes before a protrusion of the same value, however the body is turned") {
    // Both are worth 1/16: 3.75 of 60 square metres, and 5 on 80.
    const Building building = test::BoxBody()
                                  .add({0, 0, 0}, {10, 8.5, 6})
                                  .remove({2, 0, 2}, {3.5, 0.2, 4.5})
                                  .add({4, 3, 6}, {6, 5.5, 7})
                                  .build();
    for (int degrees = 0; degrees < 90; degrees += 5) {
      CAPTURE(degrees);
      const double radians = degrees * std::numbers::pi / 180;
      const Segmented s = natural(test::mapped(building, [&](Vec3 p) {
        return test::turned(p, {0, 0, 1}, radians);
      }));
      REQUIRE(s.segmentation.features.size() == 2);
      CHECK(s.segmentation.features[0].sense == Sense::hole);
    }
  }
}

}  // namespace
}  // namespace oriel
