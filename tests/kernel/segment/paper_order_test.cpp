#include "tests/support/houses.h"
#include "tests/support/near.h"
#include "tests/support/segmented.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

using doctest::Approx;
using test::in_paper_order;
using test::near;
using test::Segmented;
using test::splits_of;

void check_counts(const Segmentation& s, std::size_t leaves, std::size_t inner) {
  CHECK(s.stats.leaves == leaves);
  CHECK(s.stats.inner == inner);
  CHECK(s.stats.recursions == leaves + inner);
  CHECK(s.cells.size() == leaves);
  CHECK(s.nodes.size() == leaves + inner);
}

void check_split(const CsgNode& node, CsgNode::Kind kind, std::size_t planes, std::size_t parts,
                 double value) {
  CHECK(node.kind == kind);
  CHECK(node.planes.size() == planes);
  CHECK(node.parts.size() == parts);
  REQUIRE(node.value);
  REQUIRE(node.quality);
  CHECK(*node.value == near(value));
  CHECK(*node.quality == near(value));
}

constexpr auto kUnite = CsgNode::Kind::unite;
constexpr auto kSubtract = CsgNode::Kind::subtract;

TEST_SUITE("kernel/segment") {
  TEST_CASE("T1 two boxes on a slab are two lumps of one cut worth 1/14 each") {
    const Segmented s = in_paper_order(test::two_boxes_on_a_slab());
    check_counts(s.segmentation, 3, 1);
    const auto splits = splits_of(s.segmentation);
    REQUIRE(splits.size() == 1);
    check_split(splits[0], kUnite, 1, 2, 1.0 / 14);
    for (const Feature& f : s.segmentation.features) {
      CHECK(f.sense == Sense::protrusion);
      CHECK(f.volume_m3 == near(2));
      CHECK(f.new_area_m2 == near(2));
      CHECK(f.old_area_m2 == near(28));
      CHECK(s.segmentation.planes[f.planes.at(0).index()].normal == Vec3{0, 0, 1});
      CHECK(s.segmentation.planes[f.planes.at(0).index()].offset_m == near(2));
    }
  }

  TEST_CASE("T2 a pocket is a hole worth 1/15 and its five walls are refused") {
    const Segmented s = in_paper_order(test::pocket());
    check_counts(s.segmentation, 2, 1);
    const auto splits = splits_of(s.segmentation);
    REQUIRE(splits.size() == 1);
    check_split(splits[0], kSubtract, 1, 1, 1.0 / 15);
    REQUIRE(s.segmentation.features.size() == 1);
    CHECK(s.segmentation.features[0].sense == Sense::hole);
    CHECK(s.segmentation.features[0].box == Box{{1, 1, 1}, {2, 2, 2}});
  }

  TEST_CASE("T3 pocket before edge notch before corner notch") {
    const Segmented s = in_paper_order(test::three_notches());
    check_counts(s.segmentation, 4, 3);
    const auto splits = splits_of(s.segmentation);
    REQUIRE(splits.size() == 3);
    check_split(splits[0], kSubtract, 1, 1, 1.0 / 28);
    check_split(splits[1], kSubtract, 2, 1, 4.0 / 59);
    check_split(splits[2], kSubtract, 3, 1, 3.0 / 77);
  }

  TEST_CASE("T4 a notch over a whole side is a hole of four planes worth 5/29") {
    const Segmented s = in_paper_order(test::long_notch());
    check_counts(s.segmentation, 2, 1);
    check_split(splits_of(s.segmentation).at(0), kSubtract, 4, 1, 5.0 / 29);
  }

  TEST_CASE("T5 filling a corner for 3/7 is better than cutting it off for 3") {
    const Segmented s = in_paper_order(test::corner_notch());
    check_counts(s.segmentation, 2, 1);
    const auto splits = splits_of(s.segmentation);
    check_split(splits.at(0), kSubtract, 3, 1, 3.0 / 7);
    CHECK(s.segmentation.features.at(0).volume_m3 == near(8));
  }

  TEST_CASE("T6 six pockets are one difference of seven bodies worth 1/18 each") {
    const Segmented s = in_paper_order(test::six_pockets());
    check_counts(s.segmentation, 7, 1);
    const auto splits = splits_of(s.segmentation);
    REQUIRE(splits.size() == 1);
    check_split(splits[0], kSubtract, 1, 6, 1.0 / 18);
    CHECK(splits[0].rest.size() + splits[0].parts.size() == 7);
  }

  TEST_CASE("T7 a value of exactly 1 is refused and the corner is filled for 1/2") {
    const Segmented s = in_paper_order(test::l_of_boxes());
    check_counts(s.segmentation, 2, 1);
    check_split(splits_of(s.segmentation).at(0), kSubtract, 4, 1, 1.0 / 2);
  }

  TEST_CASE("T10 a gabled house is one leaf") {
    const Segmented s = in_paper_order(test::gabled_house());
    check_counts(s.segmentation, 1, 0);
    CHECK(s.segmentation.features.empty());
    CHECK(s.segmentation.cells[0].flag == LeafFlag::convex);
    CHECK(s.segmentation.cells[0].volume_m3 == near(720));
  }

  TEST_CASE("T11 a cross gable comes to an end with five leaves and four nodes") {
    const Segmented s = in_paper_order(test::cross_gable());
    check_counts(s.segmentation, 5, 4);
    CHECK(volume_m3(s.solid) == near(1002));
    for (const Cell& cell : s.segmentation.cells) CHECK(cell.flag == LeafFlag::convex);
  }

  TEST_CASE("T16 the house of the paper has 19 leaves under 8 nodes with the chimney first") {
    // Its coordinates are no multiples of the grid, so equal values are equal to the tolerance
    // only.
    const Segmented s = test::segmented(test::full_house(), Order::paper);
    CHECK(s.solid.planes.size() == 34);
    check_counts(s.segmentation, 19, 8);
    const auto splits = splits_of(s.segmentation);
    REQUIRE(splits.size() == 8);
    check_split(splits[0], kUnite, 1, 1, splits[0].value.value());
    CHECK(*splits[0].value == Approx(3.0 / 997).epsilon(0.002));
    check_split(splits[1], kUnite, 1, 1, 20.0 / 1489);
    check_split(splits[2], kSubtract, 1, 5, 15.0 / 503);
    check_split(splits[3], kSubtract, 1, 5, 15.0 / 503);
    check_split(splits[4], kSubtract, 1, 2, 3.0 / 94);
    check_split(splits[5], kSubtract, 1, 2, 3.0 / 94);
    check_split(splits[6], kSubtract, 2, 1, 4.0 / 229);
    check_split(splits[7], kSubtract, 2, 1, 3.0 / 172);
    CHECK(s.segmentation.features.size() == 18);
  }
}

}  // namespace
}  // namespace oriel
