#include "kernel/segment/tree/balance.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

namespace oriel {

namespace {

/// Coordinates are meetings of exact planes in doubles: what overlaps by less than this touches.
constexpr double kTouching_m = 1e-9;
/// How far rounded vertices may lie off the planes of their facets.
constexpr double kBehindPlane_m = 1e-6;

std::vector<NodeId> children_of(const CsgNode& node) {
  std::vector<NodeId> children = node.rest;
  children.insert(children.end(), node.parts.begin(), node.parts.end());
  return children;
}

/// A lump of the old tree: where it is, and how large.
struct OldLump {
  Box box;
  std::vector<Vec3> points;  ///< the vertices of its cells
  double volume_m3 = 0;
};

/// A step of the way along the rest: parts that were split off.
struct Split {
  CsgNode::Kind kind = CsgNode::Kind::unite;
  std::vector<PlaneId> planes;
  std::vector<NodeId> parts;  ///< of the old tree
};

class Balancer {
 public:
  explicit Balancer(const Segmentation& segmentation)
      : segmentation_(segmentation), lumps_(segmentation.nodes.size()) {}

  BalancedTree run() {
    tree_.root = rebuilt(segmentation_.root);
    return std::move(tree_);
  }

 private:
  /// A node of the new tree, with the old one that it was made of: for its size.
  struct Made {
    NodeId node;
    double volume_m3 = 0;
  };

  [[nodiscard]] const CsgNode& old(NodeId id) const { return segmentation_.nodes[id.index()]; }

  NodeId add(CsgNode node) {
    tree_.nodes.push_back(std::move(node));
    return NodeId{static_cast<int>(tree_.nodes.size()) - 1};
  }

  void grow(NodeId id, OldLump& lump, double sign) const {
    const CsgNode& node = old(id);
    if (node.kind == CsgNode::Kind::leaf) {
      const Cell& cell = segmentation_.cells[node.cell.index()];
      lump.volume_m3 += sign * cell.volume_m3;
      for (const Facet& facet : cell.facets)
        for (const int v : facet.loops[0]) {
          lump.points.push_back(segmentation_.vertices[at(v)].point);
          lump.box.grow(lump.points.back());
        }
      return;
    }
    for (const NodeId child : node.rest) grow(child, lump, sign);
    for (const NodeId child : node.parts)
      grow(child, lump, node.kind == CsgNode::Kind::subtract ? -sign : sign);
  }

  const OldLump& lump_of(NodeId id) {
    std::optional<OldLump>& lump = lumps_[id.index()];
    if (!lump) grow(id, lump.emplace(), 1);
    return *lump;
  }

  /// True if one of the planes of a cut has one lump before and the other one behind it.
  [[nodiscard]] bool do_planes_part(const std::vector<PlaneId>& planes, const OldLump& a,
                                    const OldLump& b) const {
    return std::ranges::any_of(planes, [&](PlaneId id) {
      const Plane& plane = segmentation_.planes[id.index()];
      const auto is_before = [&](const OldLump& lump, double side) {
        return std::ranges::all_of(lump.points, [&](Vec3 p) {
          return side * (dot(plane.normal, p) - plane.offset_m) >= -kTouching_m;
        });
      };
      return (is_before(a, 1) && is_before(b, -1)) || (is_before(a, -1) && is_before(b, 1));
    });
  }

  [[nodiscard]] bool are_apart(const Split& p, const Split& h) {
    for (const NodeId part : p.parts)
      for (const NodeId hole : h.parts) {
        const OldLump &a = lump_of(part), &b = lump_of(hole);
        const Vec3 low{std::max(a.box.min.x, b.box.min.x), std::max(a.box.min.y, b.box.min.y),
                       std::max(a.box.min.z, b.box.min.z)};
        const Vec3 high{std::min(a.box.max.x, b.box.max.x), std::min(a.box.max.y, b.box.max.y),
                        std::min(a.box.max.z, b.box.max.z)};
        const bool is_apart = high.x - low.x <= kTouching_m || high.y - low.y <= kTouching_m ||
                              high.z - low.z <= kTouching_m;
        if (!is_apart && !do_planes_part(p.planes, a, b) && !do_planes_part(h.planes, a, b))
          return false;
      }
    return true;
  }

  Made made(NodeId id) { return {rebuilt(id), lump_of(id).volume_m3}; }

  /// One node of all; the largest is the rest of a union, what is subtracted from of a difference.
  NodeId joined(CsgNode::Kind kind, std::optional<NodeId> from, std::vector<Made> parts) {
    std::ranges::stable_sort(parts, std::ranges::greater{}, &Made::volume_m3);
    if (parts.empty()) return *from;
    if (!from && parts.size() == 1) return parts[0].node;
    CsgNode node;
    node.kind = kind;
    if (from) node.rest.push_back(*from);
    for (const Made& part : parts)
      (node.rest.empty() ? node.rest : node.parts).push_back(part.node);
    return add(std::move(node));
  }

  NodeId closed_layer(std::vector<Made>& positive, const std::vector<Split>& holes) {
    const NodeId body = joined(CsgNode::Kind::unite, std::nullopt, std::move(positive));
    std::vector<Made> negative;
    for (const Split& split : holes)
      for (const NodeId part : split.parts) negative.push_back(made(part));
    return joined(CsgNode::Kind::subtract, body, std::move(negative));
  }

  NodeId rebuilt(NodeId id) {
    std::vector<Split> splits;
    NodeId base = id;
    while (old(base).kind != CsgNode::Kind::leaf && old(base).rest.size() == 1) {
      splits.push_back({old(base).kind, old(base).planes, old(base).parts});
      base = old(base).rest[0];
    }
    std::vector<Made> positive;
    std::vector<Split> holes;
    if (old(base).kind == CsgNode::Kind::leaf) {
      positive.push_back({add(old(base)), lump_of(base).volume_m3});
    } else {
      // The rest is in pieces: they are one body, from which all else is taken.
      splits.push_back({old(base).kind, old(base).planes, old(base).parts});
      for (const NodeId piece : old(base).rest) positive.push_back(made(piece));
    }
    std::ranges::reverse(splits);
    for (Split& split : splits) {
      if (split.kind == CsgNode::Kind::subtract) {
        holes.push_back(std::move(split));
        continue;
      }
      const bool is_free =
          std::ranges::all_of(holes, [&](const Split& hole) { return are_apart(split, hole); });
      if (!is_free) {
        double volume_m3 = 0;
        for (const Made& one : positive) volume_m3 += one.volume_m3;
        const NodeId body = closed_layer(positive, holes);
        positive = {{body, volume_m3}};
        holes.clear();
      }
      for (const NodeId part : split.parts) positive.push_back(made(part));
    }
    return closed_layer(positive, holes);
  }

  const Segmentation& segmentation_;
  std::vector<std::optional<OldLump>> lumps_;  ///< by old node, when it was asked for
  BalancedTree tree_;
};

/// A leaf that may merge: the cells of a node's child by their planes and vertices.
struct Hull {
  NodeId node;
  CellId cell;
  std::vector<PlaneId> planes;
  std::vector<Vec3> points;
  double volume_m3 = 0;
  std::string label;
};

class LeafMerger {
 public:
  LeafMerger(BalancedTree& tree, const Segmentation& segmentation,
             const std::vector<std::string>& labels)
      : tree_(tree), segmentation_(segmentation), labels_(labels) {}

  void run() {
    for (CsgNode& node : tree_.nodes) {
      if (node.kind == CsgNode::Kind::leaf) continue;
      if (node.kind == CsgNode::Kind::unite) {
        std::vector<NodeId> all = children_of(node);
        merge(all);
        node.rest = {all[0]};
        node.parts.assign(all.begin() + 1, all.end());
      } else {
        merge(node.parts);
      }
    }
    drop_single_unions();
  }

 private:
  [[nodiscard]] std::optional<Hull> hull_of(NodeId id) const {
    const CsgNode& node = tree_.nodes[id.index()];
    if (node.kind != CsgNode::Kind::leaf) return std::nullopt;
    const Cell& cell = segmentation_.cells[node.cell.index()];
    if (!cell.is_convex) return std::nullopt;
    Hull hull{id, node.cell, {}, {}, cell.volume_m3, "body"};
    if (cell.feature.is_valid())
      hull.label = labels_.empty() ? "part" : "part " + labels_[cell.feature.index()];
    for (const Facet& facet : cell.facets) {
      if (!lies_in_its_plane(facet)) return std::nullopt;
      hull.planes.push_back(facet.plane);
      for (const int v : facet.loops[0]) hull.points.push_back(segmentation_.vertices[at(v)].point);
    }
    std::ranges::sort(hull.planes);
    const auto twice = std::ranges::unique(hull.planes);
    hull.planes.erase(twice.begin(), twice.end());
    return hull;
  }

  [[nodiscard]] const Plane& plane(PlaneId id) const { return segmentation_.planes[id.index()]; }

  /// What is welded lies in its planes within tolerances only: then what is behind all planes of a
  /// cell is not the cell.
  [[nodiscard]] bool lies_in_its_plane(const Facet& facet) const {
    const Plane& own = plane(facet.plane);
    return std::ranges::all_of(facet.loops[0], [&](int v) {
      const Vec3 p = segmentation_.vertices[at(v)].point;
      return std::abs(dot(own.normal, p) - own.offset_m) <= kBehindPlane_m;
    });
  }

  [[nodiscard]] bool are_opposite(PlaneId p, PlaneId q) const {
    const Plane &a = plane(p), &b = plane(q);
    return a.offset == -b.offset && a.coefficients[0] == -b.coefficients[0] &&
           a.coefficients[1] == -b.coefficients[1] && a.coefficients[2] == -b.coefficients[2];
  }

  [[nodiscard]] bool is_behind_all_but(const Hull& hull, const Hull& of, PlaneId contact) const {
    return std::ranges::all_of(of.planes, [&](PlaneId id) {
      return id == contact || std::ranges::all_of(hull.points, [&](Vec3 p) {
               return dot(plane(id).normal, p) - plane(id).offset_m <= kBehindPlane_m;
             });
    });
  }

  [[nodiscard]] std::optional<LeafMerge> merge_of(const Hull& a, const Hull& b) const {
    if (a.label != b.label) return std::nullopt;
    for (const PlaneId p : a.planes)
      for (const PlaneId q : b.planes) {
        if (!are_opposite(p, q) || !is_behind_all_but(b, a, p) || !is_behind_all_but(a, b, q))
          continue;
        LeafMerge merge{a.cell, b.cell, p, {}, a.volume_m3 + b.volume_m3};
        std::ranges::set_union(a.planes, b.planes, std::back_inserter(merge.planes));
        std::erase_if(merge.planes, [&](PlaneId id) { return id == p || id == q; });
        return merge;
      }
    return std::nullopt;
  }

  /// Merges leaves among the children of a node, until none fit any more.
  void merge(std::vector<NodeId>& children) {
    std::vector<Hull> hulls;
    for (const NodeId child : children)
      if (auto hull = hull_of(child)) hulls.push_back(std::move(*hull));
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      std::ranges::stable_sort(hulls, std::ranges::greater{}, &Hull::volume_m3);
      for (std::size_t i = 0; i < hulls.size() && !has_changed; ++i)
        for (std::size_t k = i + 1; k < hulls.size() && !has_changed; ++k) {
          const auto merge = merge_of(hulls[i], hulls[k]);
          if (!merge) continue;
          hulls[i].planes = merge->planes;
          hulls[i].points.insert(hulls[i].points.end(), hulls[k].points.begin(),
                                 hulls[k].points.end());
          hulls[i].volume_m3 = merge->volume_m3;
          std::erase(children, hulls[k].node);
          hulls.erase(hulls.begin() + static_cast<std::ptrdiff_t>(k));
          tree_.merges.push_back(*merge);
          has_changed = true;
        }
    }
  }

  /// A union of which one child is left is that child.
  void drop_single_unions() {
    const auto only = [&](NodeId id) {
      while (true) {
        const CsgNode& node = tree_.nodes[id.index()];
        if (node.kind != CsgNode::Kind::unite || !node.parts.empty()) return id;
        id = node.rest[0];
      }
    };
    for (CsgNode& node : tree_.nodes)
      for (auto* list : {&node.rest, &node.parts})
        for (NodeId& child : *list) child = only(child);
    tree_.root = only(tree_.root);
  }

  BalancedTree& tree_;
  const Segmentation& segmentation_;
  const std::vector<std::string>& labels_;
};

}  // namespace

BalancedTree balance(const Segmentation& segmentation) { return Balancer(segmentation).run(); }

void merge_touching(BalancedTree& tree, const Segmentation& segmentation,
                    const std::vector<std::string>& labels) {
  LeafMerger(tree, segmentation, labels).run();
}

}  // namespace oriel
