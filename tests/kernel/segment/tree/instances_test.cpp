#include "tests/kernel/segment/invariants.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <set>
#include <tuple>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::in_paper_order;
using test::Segmented;

/// A wall with three pockets, each with a niche of that size in its back, which in the last pocket
/// is moved up.
Building pockets_with_niches(double size, double moved) {
  BoxBody body;
  body.add({0, 0, 0}, {20, 6, 8});
  for (const double x : {2.0, 8.0, 14.0}) {
    const double up = x == 14 ? moved : 0;
    const double side = (3 - size) / 2;
    body.remove({x, 0, 2}, {x + 3, 1, 5})
        .remove({x + side, 1, 2 + side + up}, {x + 3 - side, 1.5, 5 - side + up});
  }
  return body.build();
}

/// The features' boxes and measures, whatever their order.
std::set<std::tuple<double, double, double, double, double, double>> shapes_of(const Segmented& s) {
  std::set<std::tuple<double, double, double, double, double, double>> shapes;
  for (const Feature& f : s.segmentation.features)
    shapes.emplace(f.box.min.x, f.box.min.y, f.box.min.z, f.box.max.z, f.volume_m3, *f.value);
  return shapes;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("congruent parts of a node are segmented once and counted") {
    CHECK(in_paper_order(test::six_pockets()).segmentation.stats.instanced == 5);
    CHECK(in_paper_order(pockets_with_niches(2, 0)).segmentation.stats.instanced == 2);
  }

  TEST_CASE("an instanced part has what its model has, in its own place") {
    const Segmented s = in_paper_order(pockets_with_niches(2, 0));
    CHECK(s.segmentation.features.size() == 6);
    test::check_segmentation(s);
    for (const double x : {2.0, 8.0, 14.0}) {
      const FeatureId pocket = test::feature_in(s.segmentation, {x, 0, 2}, {x + 3, 1.5, 5});
      const FeatureId niche =
          test::feature_in(s.segmentation, {x + 0.5, 1, 2.5}, {x + 2.5, 1.5, 4.5});
      REQUIRE(pocket.is_valid());
      REQUIRE(niche.is_valid());
      CHECK(s.segmentation.features[niche.index()].parent == pocket);
    }
  }

  TEST_CASE("what was cut from equal parts before hangs on each of them") {
    // Small niches go first, then the pockets that they were in.
    const Segmented s = in_paper_order(pockets_with_niches(1, 0));
    CHECK(s.segmentation.stats.instanced == 2);
    for (const double x : {2.0, 8.0, 14.0}) {
      const FeatureId pocket = test::feature_in(s.segmentation, {x, 0, 2}, {x + 3, 1, 5});
      const FeatureId niche = test::feature_in(s.segmentation, {x + 1, 1, 3}, {x + 2, 1.5, 4});
      REQUIRE(pocket.is_valid());
      REQUIRE(niche.is_valid());
      CHECK(s.segmentation.features[niche.index()].host == pocket);
      CHECK(s.segmentation.features[niche.index()].host_facet.has_value());
    }
  }

  TEST_CASE("a part that differs inside is segmented itself") {
    const Segmented s = in_paper_order(pockets_with_niches(2, 0.25));
    CHECK(s.segmentation.stats.instanced == 1);
    CHECK(shapes_of(s).size() == 6);
    test::check_segmentation(s);
  }

  TEST_CASE("parts of equal value and unlike height are not congruent") {
    const Segmented s = in_paper_order(BoxBody()
                                           .add({0, 0, 0}, {8, 4, 2})
                                           .add({1, 1, 2}, {2, 3, 3})
                                           .add({5, 1, 2}, {6, 3, 4})
                                           .build());
    CHECK(s.segmentation.features.size() == 2);
    CHECK(s.segmentation.stats.instanced == 0);
  }

  TEST_CASE("in the natural order congruent parts are instanced too") {
    const Segmented s = test::segmented(pockets_with_niches(2, 0), Order::natural);
    CHECK(s.segmentation.stats.instanced == 2);
    test::check_segmentation(s);
  }

  TEST_CASE("pockets of two kinds behind one outline are copied each in its own place") {
    // Deep ones and flat ones by turns, each with a niche in its back.
    BoxBody body;
    body.add({0, 0, 0}, {24, 6, 8});
    const auto depth_at = [](int i) { return i % 2 == 0 ? 1.0 : 0.75; };
    for (int i = 0; i < 4; ++i) {
      const double x = 2 + 5 * i, y = depth_at(i);
      body.remove({x, 0, 2}, {x + 3, y, 5}).remove({x + 0.5, y, 2.5}, {x + 2.5, 1.5, 4.5});
    }
    const Segmented s = test::segmented(body.build(), Order::natural);
    CHECK(s.segmentation.stats.instanced == 2);
    CHECK(s.segmentation.features.size() == 8);
    test::check_segmentation(s);
    for (int i = 0; i < 4; ++i) {
      const double x = 2 + 5 * i;
      const FeatureId pocket = test::feature_in(s.segmentation, {x, 0, 2}, {x + 3, 1.5, 5});
      const FeatureId niche =
          test::feature_in(s.segmentation, {x + 0.5, depth_at(i), 2.5}, {x + 2.5, 1.5, 4.5});
      REQUIRE(pocket.is_valid());
      REQUIRE(niche.is_valid());
      CHECK(s.segmentation.features[niche.index()].parent == pocket);
      CHECK(s.segmentation.features[pocket.index()].volume_m3 ==
            doctest::Approx(9 * depth_at(i) + 4 * (1.5 - depth_at(i))));
    }
  }

  TEST_CASE("a lone pocket is a leaf with all its facets be it of air or of material") {
    const Segmented s = test::segmented(BoxBody()
                                            .add({0, 0, 0}, {12, 6, 8})
                                            .remove({2, 0, 2}, {4, 1, 5})
                                            .add({7, -1, 2}, {9, 0, 4})
                                            .build(),
                                        Order::natural);
    test::check_segmentation(s);
    const auto cell_of = [&](Vec3 min, Vec3 max) {
      const FeatureId id = test::feature_in(s.segmentation, min, max);
      REQUIRE(id.is_valid());
      const Feature& feature = s.segmentation.features[id.index()];
      return s.segmentation.cells[s.segmentation.nodes[feature.node.index()].cell.index()];
    };
    const Cell air = cell_of({2, 0, 2}, {4, 1, 5}), block = cell_of({7, -1, 2}, {9, 0, 4});
    CHECK(air.sign == -1);
    CHECK(air.volume_m3 == doctest::Approx(6));
    CHECK(block.sign == 1);
    CHECK(block.volume_m3 == doctest::Approx(4));
    for (const Cell& cell : {air, block}) {
      CHECK(cell.facets.size() == 6);
      // What the input drew, so all but the cap.
      CHECK(std::ranges::count_if(cell.facets,
                                  [](const Facet& facet) { return !facet.polygons.empty(); }) == 5);
    }
  }
}

}  // namespace
}  // namespace oriel
