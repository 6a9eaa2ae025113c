#include "tests/kernel/segment/invariants.h"

#include "kernel/segment/tree/balance.h"
#include "tests/support/houses.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("every body is the sum of its cells and the value of its tree in both orders") {
    for (const auto& [name, make] : test::bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        CAPTURE(to_string(order));
        test::check_segmentation(test::segmented(make(), order));
      }
  }

  TEST_CASE("a balanced tree is the same body as the one that was cut") {
    for (const auto& [name, make] : test::bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        CAPTURE(to_string(order));
        test::check_balanced(test::segmented(make(), order).segmentation);
      }
  }

  TEST_CASE("balancing leaves one level for each nesting however many parts there are") {
    const Segmentation s = test::segmented(test::full_house()).segmentation;
    const TreeFigures cut = figures_of(s), balanced = figures_of(balance(s), s);
    CHECK(cut.leaves == 19);
    CHECK(cut.inner == 8);
    CHECK(cut.depth == 8);
    CHECK(cut.weighted_path > 7);
    // The house and the chimney in a union, from which windows and doors are taken.
    CHECK(balanced.leaves == 19);
    CHECK(balanced.inner < cut.inner);
    CHECK(balanced.depth <= 4);
    CHECK(balanced.weighted_path < 3);
  }

  TEST_CASE("the largest part stands first") {
    const Segmentation s = test::segmented(test::BoxBody()
                                               .add({0, 0, 0}, {20, 10, 4})
                                               .add({1, 1, 4}, {2, 2, 5})
                                               .add({5, 1, 4}, {9, 5, 8})
                                               .add({12, 1, 4}, {14, 3, 7})
                                               .build())
                               .segmentation;
    const BalancedTree tree = balance(s);
    const CsgNode& root = tree.nodes[tree.root.index()];
    REQUIRE(root.kind == CsgNode::Kind::unite);
    REQUIRE(root.parts.size() == 3);
    double before_m3 = 1000;
    for (const NodeId part : root.parts) {
      const double volume_m3 = s.cells[tree.nodes[part.index()].cell.index()].volume_m3;
      CHECK(volume_m3 < before_m3);
      before_m3 = volume_m3;
    }
  }

  TEST_CASE("the proof finds a tree that is another body") {
    const Segmentation s = test::segmented(test::full_house()).segmentation;
    const BalancedTree good = balance(s);
    BalancedTree other = good;
    for (CsgNode& node : other.nodes)
      if (node.kind == CsgNode::Kind::subtract) node.kind = CsgNode::Kind::unite;
    CHECK_FALSE(prove(other, s).has_same_cells);
    CHECK(prove(other, s).differing > 0);
    CHECK(prove(other, s).before_m3 != prove(other, s).after_m3);
    other = good;
    for (CsgNode& node : other.nodes)
      if (!node.parts.empty()) node.parts.pop_back();
    CHECK_FALSE(prove(other, s).has_same_cells);
    CHECK(prove(other, s).differing > 0);
  }

  TEST_CASE("touching parts whose union is convex become one and fall apart again") {
    // Figure 8: the plane y = 2 of the tower cuts the lower box beside it in two.
    const Segmentation s = test::segmented(test::BoxBody()
                                               .add({0, 0, 0}, {8, 8, 2})
                                               .add({1, 0, 2}, {4, 3, 3})
                                               .add({4, 0, 2}, {7, 2, 5})
                                               .build())
                               .segmentation;
    BalancedTree tree = balance(s);
    const std::size_t leaves = figures_of(tree, s).leaves;
    merge_touching(tree, s);
    REQUIRE_FALSE(tree.merges.empty());
    CHECK(figures_of(tree, s).leaves == leaves - tree.merges.size());
    CHECK(prove(tree, s).holds());
    double largest_m3 = 0;
    for (const LeafMerge& merge : tree.merges) {
      largest_m3 = std::max(largest_m3, merge.volume_m3);
      const Plane& contact = s.planes[merge.contact.index()];
      const auto is_on_side = [&](CellId id, double side) {
        for (const Facet& facet : s.cells[id.index()].facets)
          for (const int v : facet.loops[0])
            if (side * (dot(contact.normal, s.vertices[static_cast<std::size_t>(v)].point) -
                        contact.offset_m) <
                -1e-9)
              return false;
        return true;
      };
      CHECK(is_on_side(merge.first, -1));
      CHECK(is_on_side(merge.second, 1));
    }
    CHECK(largest_m3 == doctest::Approx(3 * 3 * 1.0).epsilon(1e-9));

    // A corner that was welded lies in its planes within tolerances only.
    Segmentation welded = s;
    for (const Facet& facet : s.cells[tree.merges[0].second.index()].facets) {
      if (facet.plane == tree.merges[0].contact) continue;
      Vertex& corner = welded.vertices[static_cast<std::size_t>(facet.loops[0][0])];
      corner = {corner.point - 0.002 * s.planes[facet.plane.index()].normal, false};
    }
    BalancedTree of_welded = balance(welded);
    merge_touching(of_welded, welded);
    CHECK(of_welded.merges.size() < tree.merges.size());
    CHECK(prove(of_welded, welded).differing == 0);

    BalancedTree apart = balance(s);
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < s.features.size(); ++i) labels.push_back(std::to_string(i));
    merge_touching(apart, s, labels);
    CHECK(apart.merges.empty());
  }
}

}  // namespace
}  // namespace oriel
