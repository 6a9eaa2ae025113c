#include "tests/kernel/segment/invariants.h"

#include "kernel/segment/tree/balance.h"
#include "tests/support/inside.h"

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

bool is_in_range(int index, std::size_t size) {
  return index >= 0 && index < static_cast<int>(size);
}

/// Termination does not need its safety net.
void check_flags(const Segmentation& s) {
  CHECK(
      std::ranges::none_of(s.cells, [](const Cell& cell) { return cell.flag == LeafFlag::cycle; }));
}

void check_tree(const Segmentation& s) {
  check_flags(s);
  std::vector<int> uses(s.nodes.size(), 0), cell_uses(s.cells.size(), 0);
  ++uses[s.root.index()];
  std::size_t inner = 0;
  for (int n = 0; n < std::ssize(s.nodes); ++n) {
    const CsgNode& node = s.nodes[static_cast<std::size_t>(n)];
    if (node.kind == CsgNode::Kind::leaf) {
      REQUIRE(is_in_range(node.cell.value, s.cells.size()));
      ++cell_uses[node.cell.index()];
      CHECK(s.cells[node.cell.index()].node == NodeId{n});
      CHECK(node.rest.size() + node.parts.size() == 0);
      continue;
    }
    ++inner;
    CHECK_FALSE(node.rest.empty());
    CHECK_FALSE(node.cell.is_valid());
    CHECK(node.planes.size() <= 4);
    CHECK(std::ranges::is_sorted(node.planes));
    CHECK(node.value.has_value() == !node.parts.empty());
    for (const auto* children : {&node.rest, &node.parts})
      for (const NodeId child : *children) {
        REQUIRE(is_in_range(child.value, s.nodes.size()));
        CHECK(child.value > n);
        ++uses[child.index()];
      }
  }
  CHECK(std::ranges::count(uses, 1) == std::ssize(uses));
  CHECK(std::ranges::count(cell_uses, 1) == std::ssize(cell_uses));
  CHECK(s.stats.leaves == s.cells.size());
  CHECK(s.stats.inner == inner);
  CHECK(s.stats.recursions == s.nodes.size());
}

/// Signs and features of cells are those of their place in the tree.
void check_path(const Segmentation& s, NodeId id, int sign, FeatureId feature) {
  const CsgNode& node = s.nodes[id.index()];
  if (node.kind == CsgNode::Kind::leaf) {
    CHECK(s.cells[node.cell.index()].sign == sign);
    CHECK(s.cells[node.cell.index()].feature == feature);
  }
  for (const NodeId child : node.rest) check_path(s, child, sign, feature);
  for (const NodeId child : node.parts) {
    const auto found = std::ranges::find(s.features, child, &Feature::node);
    REQUIRE(found != s.features.end());
    const FeatureId id_of_part{static_cast<int>(found - s.features.begin())};
    const int sign_of_part = node.kind == CsgNode::Kind::subtract ? -sign : sign;
    CHECK(found->parent == feature);
    CHECK((found->sense == Sense::protrusion) == (sign_of_part > 0));
    check_path(s, child, sign_of_part, id_of_part);
  }
}

void check_features(const Segmentation& s) {
  std::size_t parts = 0;
  for (const CsgNode& node : s.nodes) parts += node.parts.size();
  CHECK(s.features.size() == parts);
  for (int i = 0; i < std::ssize(s.features); ++i) {
    CAPTURE(i);
    const Feature& f = s.features[static_cast<std::size_t>(i)];
    CHECK(f.parent.value < i);
    CHECK(f.host.value < std::ssize(s.features));
    CHECK(f.host != FeatureId{i});
    CHECK(f.volume_m3 > 0);
    CHECK(f.surface_m2 > 0);
    CHECK(std::ranges::is_sorted(f.vertices));
    CHECK(std::ranges::is_sorted(f.source_polygons));
    Box box;
    for (const int v : f.vertices) {
      REQUIRE(is_in_range(v, s.vertices.size()));
      box.grow(s.vertices[static_cast<std::size_t>(v)].point);
    }
    CHECK(box == f.box);
    if (f.sense == Sense::cavity) {
      CHECK(f.planes.empty());
      CHECK_FALSE(f.host_facet);
      continue;
    }
    CHECK(f.new_area_m2 > 0);
    CHECK(f.old_area_m2 > 0);
    CHECK(*f.quality == doctest::Approx(f.new_area_m2 / f.old_area_m2).epsilon(1e-9));
    REQUIRE_FALSE(f.planes.empty());
    const Plane& plane = s.planes[f.planes[0].index()];
    CHECK(std::abs(dot(plane.normal, f.cap_point) - plane.offset_m) < 1e-6);
    CHECK(f.host_facet);
    if (!f.host_facet) continue;
    REQUIRE(is_in_range(f.host_facet->cell.value, s.cells.size()));
    const Cell& cell = s.cells[f.host_facet->cell.index()];
    REQUIRE(is_in_range(f.host_facet->facet, cell.facets.size()));
    CHECK(cell.feature == f.host);
    // The host's facet lies in the cap's plane. A void's facets look out of the void.
    const Plane& of_host =
        s.planes[cell.facets[static_cast<std::size_t>(f.host_facet->facet)].plane.index()];
    CHECK(dot(of_host.normal, plane.normal) * cell.sign == doctest::Approx(1).epsilon(1e-9));
    CHECK(of_host.offset_m * cell.sign == doctest::Approx(plane.offset_m).epsilon(1e-9));
  }
}

void check_cells(const Segmented& s, const Exactness& exactness) {
  double sum = 0, size = 0;
  for (std::size_t c = 0; c < s.segmentation.cells.size(); ++c) {
    CAPTURE(c);
    const Cell& cell = s.segmentation.cells[c];
    const Solid body = solid_of(s.segmentation, cell);
    CHECK(is_closed(body));
    CHECK(cell.is_convex == (cell.flag == LeafFlag::convex));
    sum += cell.sign * cell.volume_m3;
    size += std::abs(cell.volume_m3);
    if (!exactness.has_sound_cells) continue;
    CHECK(cell.volume_m3 > 0);
    // Its loops leave out vertices on straight edges, which may be as far off the edge as vertices
    // may be off their planes.
    CHECK(std::abs(cell.volume_m3 - volume_m3(body)) <= exactness.planarity_m * surface_m2(body));
    if (!cell.is_convex) continue;
    double highest = -Box::kInfinity;
    for (const Facet& facet : cell.facets)
      for (const Facet& other : cell.facets)
        for (const Loop& loop : other.loops)
          for (const int v : loop) {
            const Plane& plane = s.segmentation.planes[facet.plane.index()];
            highest = std::max(
                highest,
                dot(plane.normal, s.segmentation.vertices[static_cast<std::size_t>(v)].point) -
                    plane.offset_m);
          }
    CHECK(highest < exactness.planarity_m);
  }
  CHECK(std::abs(sum - volume_m3(s.solid)) <= exactness.area_rel * size);
}

void check_points(const Segmented& s, const Exactness& exactness) {
  const Surface solid = surface_of(s.solid);
  Cells cells(s.segmentation);
  const double gap = std::max(1e-6, 2 * exactness.planarity_m);
  int wrong_sums = 0, wrong_trees = 0, inside = 0, outside = 0;
  for (const Vec3 p : solid.samples(exactness.samples, gap, 4 * gap)) {
    const bool is_inside = solid.contains(p);
    (is_inside ? inside : outside) += 1;
    cells.look_at(p);
    wrong_sums += cells.sum_of_signs() != (is_inside ? 1 : 0) ? 1 : 0;
    wrong_trees += cells.is_in(s.segmentation.root) != is_inside ? 1 : 0;
  }
  CHECK(inside > exactness.samples / 20);
  CHECK(outside > exactness.samples / 20);
  CHECK(wrong_sums == 0);
  CHECK(wrong_trees == 0);
}

}  // namespace

void check_segmentation(const Segmented& s, const Exactness& exactness) {
  check_tree(s.segmentation);
  check_path(s.segmentation, s.segmentation.root, 1, {});
  check_features(s.segmentation);
  check_cells(s, exactness);
  check_points(s, exactness);
}

std::size_t check_balanced(const Segmentation& segmentation) {
  const TreeFigures cut = figures_of(segmentation);
  BalancedTree tree = balance(segmentation);
  const TreeFigures balanced = figures_of(tree, segmentation);
  CHECK(balanced.leaves == cut.leaves);
  CHECK(balanced.depth <=
        cut.depth + 1);  // a difference of a union: two levels where there was one
  const BalanceProof proof = prove(tree, segmentation);
  CHECK(proof.has_same_cells);
  CHECK(proof.before_m3 == proof.after_m3);
  CHECK(proof.points > 0);
  CHECK(proof.differing == 0);
  merge_touching(tree, segmentation);
  CHECK(figures_of(tree, segmentation).leaves + tree.merges.size() == cut.leaves);
  CHECK(prove(tree, segmentation).holds());
  return tree.merges.size();
}

}  // namespace oriel::test
