#include "tests/support/houses.h"
#include "tests/support/near.h"
#include "tests/support/segmented.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::feature_in;
using test::near;
using test::Segmented;

Vec3 normal_of(const Segmentation& s, const Feature& f) {
  return s.planes[f.planes.at(0).index()].normal;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("what stands in a void is material whose plane looks out of the building") {
    for (const Order order : {Order::natural, Order::paper}) {
      CAPTURE(to_string(order));
      const Segmented s = test::segmented(test::terrace_with_block(), order);
      REQUIRE(s.segmentation.features.size() == 2);
      const FeatureId terrace = feature_in(s.segmentation, {2, 2, 4}, {8, 6, 6});
      const FeatureId block = feature_in(s.segmentation, {3, 3, 4}, {6, 5, 5.5});
      REQUIRE(terrace.is_valid());
      REQUIRE(block.is_valid());
      const Feature& air = s.segmentation.features[terrace.index()];
      const Feature& material = s.segmentation.features[block.index()];
      CHECK(air.sense == Sense::hole);
      CHECK(material.sense == Sense::protrusion);
      if (order == Order::natural) CHECK(material.parent == terrace);
      CHECK(material.host == terrace);
      CHECK(normal_of(s.segmentation, air) == Vec3{0, 0, 1});
      CHECK(normal_of(s.segmentation, material) == Vec3{0, 0, 1});
      CHECK(material.volume_m3 == near(9));
      CHECK(material.new_area_m2 == near(6));
      for (const Cell& cell : s.segmentation.cells)
        CHECK(cell.sign == (cell.feature == terrace ? -1 : 1));
    }
  }

  TEST_CASE(
      "a small chimney in a sunk terrace is cut first and stands on the terrace all the same") {
    const Segmented s = test::segmented(test::terrace_with_chimney(), Order::natural);
    REQUIRE(s.segmentation.features.size() == 2);
    const Feature &chimney = s.segmentation.features[0], &terrace = s.segmentation.features[1];
    CHECK(chimney.sense == Sense::protrusion);
    CHECK(terrace.sense == Sense::hole);
    CHECK_FALSE(chimney.parent.is_valid());
    CHECK(chimney.host == FeatureId{1});
  }

  TEST_CASE("a box in a window niche sticks out of the back wall") {
    const Segmented s = test::segmented(test::window_with_box(), Order::natural);
    REQUIRE(s.segmentation.features.size() == 2);
    const Feature &niche = s.segmentation.features[0], &thing = s.segmentation.features[1];
    CHECK(niche.sense == Sense::hole);
    CHECK(thing.sense == Sense::protrusion);
    CHECK(thing.parent == FeatureId{0});
    CHECK(thing.host == FeatureId{0});
    CHECK(normal_of(s.segmentation, thing) == Vec3{0, -1, 0});
    CHECK(niche.volume_m3 == near(1.6 - 0.2));
    CHECK(thing.volume_m3 == near(0.2));
  }

  TEST_CASE("senses alternate through three levels of void and material") {
    // A pit, in it a block, in the block a smaller pit; each too large to be split off before its
    // carrier.
    const Segmented s = test::segmented(test::BoxBody()
                                            .add({0, 0, 0}, {20, 20, 10})
                                            .remove({2, 2, 5}, {18, 18, 10})
                                            .add({4, 4, 5}, {16, 16, 9})
                                            .remove({5, 5, 7}, {15, 15, 9})
                                            .build(),
                                        Order::natural);
    const FeatureId pit = feature_in(s.segmentation, {2, 2, 5}, {18, 18, 10});
    const FeatureId block = feature_in(s.segmentation, {4, 4, 5}, {16, 16, 9});
    const FeatureId inner = feature_in(s.segmentation, {5, 5, 7}, {15, 15, 9});
    for (const FeatureId id : {pit, block, inner}) REQUIRE(id.is_valid());
    const auto& features = s.segmentation.features;
    CHECK(features[pit.index()].sense == Sense::hole);
    CHECK(features[block.index()].sense == Sense::protrusion);
    CHECK(features[inner.index()].sense == Sense::hole);
    CHECK(features[block.index()].host == pit);
    CHECK(features[inner.index()].host == block);
    for (const FeatureId id : {pit, block, inner})
      CHECK(normal_of(s.segmentation, features[id.index()]) == Vec3{0, 0, 1});
  }

  TEST_CASE("a cavity is a feature without planes and lumps hang under a root that cuts nothing") {
    const Segmented s = test::segmented(test::cavity_and_lumps(), Order::natural);
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& cavity = s.segmentation.features[0];
    CHECK(cavity.sense == Sense::cavity);
    CHECK(cavity.planes.empty());
    CHECK(*cavity.value == 0);
    CHECK(cavity.volume_m3 == near(64));
    const CsgNode& root = s.segmentation.nodes[s.segmentation.root.index()];
    CHECK(root.kind == CsgNode::Kind::unite);
    CHECK(root.planes.empty());
    CHECK(root.rest.size() == 3);
    CHECK(root.parts.empty());
    CHECK_FALSE(root.value);
  }

  TEST_CASE("a recess inside a cavity belongs to the cavity") {
    const Segmented s = test::segmented(test::BoxBody()
                                            .add({0, 0, 0}, {10, 10, 10})
                                            .remove({2, 2, 2}, {8, 8, 8})
                                            .add({4, 4, 2}, {5, 5, 4})
                                            .build(),
                                        Order::natural);
    const FeatureId post = feature_in(s.segmentation, {4, 4, 2}, {5, 5, 4});
    REQUIRE(post.is_valid());
    CHECK(s.segmentation.features[post.index()].sense == Sense::protrusion);
    CHECK(s.segmentation.features[0].sense == Sense::cavity);
    CHECK(s.segmentation.features[post.index()].parent == FeatureId{0});
    CHECK(normal_of(s.segmentation, s.segmentation.features[post.index()]) == Vec3{0, 0, 1});
  }
}

}  // namespace
}  // namespace oriel
