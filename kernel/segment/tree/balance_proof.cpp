#include "kernel/base/index.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/tree/balance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace oriel {

namespace {

/// How far points are drawn before and behind facets, and how near to a facet none is asked for:
/// there the answer is that of rounding.
constexpr double kBeside_m = 1e-3, kTooNear_m = 1e-6;

/// A tree, and what its leaves are.
struct TreeView {
  const std::vector<CsgNode>& nodes;
  NodeId root;
  /// Merges by the leaf that is left of them, the last one.
  std::map<CellId, const LeafMerge*> merged;
  /// All cells of a merged leaf.
  std::map<CellId, std::vector<CellId>> cells;
};

TreeView view_of(const Segmentation& segmentation) {
  return {segmentation.nodes, segmentation.root, {}, {}};
}

TreeView view_of(const BalancedTree& tree) {
  TreeView view{tree.nodes, tree.root, {}, {}};
  for (const LeafMerge& merge : tree.merges) {
    view.merged[merge.first] = &merge;
    auto& cells = view.cells[merge.first];
    if (cells.empty()) cells.push_back(merge.first);
    const auto second = view.cells.find(merge.second);
    if (second == view.cells.end())
      cells.push_back(merge.second);
    else
      cells.insert(cells.end(), second->second.begin(), second->second.end());
  }
  return view;
}

class TreeWalk {
 public:
  TreeWalk(const TreeView& view, const Segmentation& segmentation)
      : view_(view), segmentation_(segmentation) {}

  TreeFigures run() {
    visit(view_.root, 0);
    if (volume_m3_ > 0) out_.weighted_path /= volume_m3_;
    return out_;
  }

 private:
  void visit(NodeId id, std::size_t depth) {
    const CsgNode& node = view_.nodes[id.index()];
    out_.depth = std::max(out_.depth, depth);
    if (node.kind == CsgNode::Kind::leaf) {
      ++out_.leaves;
      const auto merge = view_.merged.find(node.cell);
      const double volume_m3 = merge == view_.merged.end()
                                   ? segmentation_.cells[node.cell.index()].volume_m3
                                   : merge->second->volume_m3;
      out_.weighted_path += volume_m3 * static_cast<double>(depth);
      volume_m3_ += volume_m3;
      return;
    }
    ++out_.inner;
    for (const auto* list : {&node.rest, &node.parts})
      for (const NodeId child : *list) visit(child, depth + 1);
  }

  const TreeView& view_;
  const Segmentation& segmentation_;
  TreeFigures out_;
  double volume_m3_ = 0;
};

/// The sign of each cell in a tree; 0: it is not there, or more than once.
std::vector<int> signs_of(const TreeView& view, std::size_t count) {
  std::vector<int> signs(count, 0), times(count, 0);
  const auto visit = [&](const auto& self, NodeId id, int sign) -> void {
    const CsgNode& node = view.nodes[id.index()];
    if (node.kind == CsgNode::Kind::leaf) {
      const auto merged = view.cells.find(node.cell);
      const std::vector<CellId> alone{node.cell};
      for (const CellId cell : merged == view.cells.end() ? alone : merged->second) {
        signs[cell.index()] = sign;
        ++times[cell.index()];
      }
      return;
    }
    for (const NodeId child : node.rest) self(self, child, sign);
    for (const NodeId child : node.parts)
      self(self, child, node.kind == CsgNode::Kind::subtract ? -sign : sign);
  };
  visit(visit, view.root, 1);
  for (std::size_t i = 0; i < count; ++i)
    if (times[i] != 1) signs[i] = 0;
  return signs;
}

/// A facet of a cell.
struct CellPane {
  std::vector<Outline> outlines;
  const Plane* plane = nullptr;
};

/// At one point after the other.
class Evaluation {
 public:
  Evaluation(const Segmentation& segmentation, Work& work)
      : segmentation_(segmentation), work_(work), is_in_cell_(segmentation.cells.size()) {
    for (const Cell& cell : segmentation.cells) {
      auto& panes = panes_.emplace_back();
      Box& box = boxes_.emplace_back();
      for (const Facet& facet : cell.facets) {
        CellPane pane{outlines_of(segmentation.vertices, facet.loops),
                      &segmentation.planes[facet.plane.index()]};
        for (const Vec3 p : pane.outlines[0]) box.grow(p);
        panes.push_back(std::move(pane));
      }
    }
  }

  /// Where trees are evaluated from now on.
  void go_to(Vec3 p) {
    point_ = p;
    std::ranges::fill(is_in_cell_, std::nullopt);
  }

  /// Calls `visit(point)` beside every facet, on both sides, but not within kTooNear_m of a facet's
  /// plane, until the work is used up.
  template <class Visit>
  void for_each_point(Visit visit) {
    for (const auto& panes : panes_)
      for (const CellPane& pane : panes)
        if (const auto p = interior_point(pane.outlines, pane.plane->normal))
          for (const double side : {kBeside_m, -kBeside_m}) {
            if (work_.is_used_up()) return;
            const Vec3 beside = *p + side * pane.plane->normal;
            if (!is_too_near(beside)) visit(beside);
          }
  }

  [[nodiscard]] bool is_in(const TreeView& view, NodeId id) {
    const CsgNode& node = view.nodes[id.index()];
    const auto has = [&](NodeId child) { return is_in(view, child); };
    switch (node.kind) {
      case CsgNode::Kind::leaf:
        if (const auto merge = view.merged.find(node.cell); merge != view.merged.end())
          return is_behind_all(merge->second->planes);
        return is_in_cell(node.cell);
      case CsgNode::Kind::unite:
        return std::ranges::any_of(node.rest, has) || std::ranges::any_of(node.parts, has);
      case CsgNode::Kind::subtract:
        return std::ranges::any_of(node.rest, has) && std::ranges::none_of(node.parts, has);
    }
    return false;
  }

 private:
  [[nodiscard]] static bool is_in_box(const Box& box, Vec3 p, double margin_m) {
    return p.x >= box.min.x - margin_m && p.x <= box.max.x + margin_m &&
           p.y >= box.min.y - margin_m && p.y <= box.max.y + margin_m &&
           p.z >= box.min.z - margin_m && p.z <= box.max.z + margin_m;
  }

  [[nodiscard]] bool is_too_near(Vec3 p) {
    for (std::size_t c = 0; c < panes_.size(); ++c) {
      if (!is_in_box(boxes_[c], p, kTooNear_m)) continue;
      work_.add_flat(std::ssize(panes_[c]));
      if (std::ranges::any_of(panes_[c], [&](const CellPane& pane) {
            return std::abs(dot(pane.plane->normal, p) - pane.plane->offset_m) < kTooNear_m;
          }))
        return true;
    }
    return false;
  }

  /// Each cell is asked once: both trees have it.
  [[nodiscard]] bool is_in_cell(CellId id) {
    std::optional<bool>& is_in = is_in_cell_[id.index()];
    if (!is_in) is_in = is_in_box(boxes_[id.index()], point_, 0) && winds_round(id);
    return *is_in;
  }

  [[nodiscard]] bool winds_round(CellId id) {
    constexpr double kHalf = 0.5;  // the winding number is 0 or 1
    double winding = 0;
    for (const CellPane& pane : panes_[id.index()]) {
      for (const Outline& outline : pane.outlines) work_.add(std::ssize(outline));
      winding += winding_part(pane.outlines, point_);
    }
    return winding > kHalf;
  }

  [[nodiscard]] bool is_behind_all(const std::vector<PlaneId>& planes) const {
    return std::ranges::all_of(planes, [&](PlaneId id) {
      const Plane& plane = segmentation_.planes[id.index()];
      return dot(plane.normal, point_) <= plane.offset_m;
    });
  }

  const Segmentation& segmentation_;
  Work& work_;
  Vec3 point_{};
  std::vector<std::optional<bool>> is_in_cell_;  ///< at the point, where it was asked
  std::vector<std::vector<CellPane>> panes_;     ///< by cell
  std::vector<Box> boxes_;
};

}  // namespace

TreeFigures figures_of(const Segmentation& segmentation) {
  return TreeWalk(view_of(segmentation), segmentation).run();
}

TreeFigures figures_of(const BalancedTree& tree, const Segmentation& segmentation) {
  return TreeWalk(view_of(tree), segmentation).run();
}

BalanceProof prove(const BalancedTree& tree, const Segmentation& segmentation) {
  Work work;
  return prove(tree, segmentation, work);
}

BalanceProof prove(const BalancedTree& tree, const Segmentation& segmentation, Work& work) {
  const TreeView before = view_of(segmentation), after = view_of(tree);
  BalanceProof proof;
  const std::vector<int> signs = signs_of(after, segmentation.cells.size());
  proof.has_same_cells = true;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const Cell& cell = segmentation.cells[i];
    proof.has_same_cells = proof.has_same_cells && signs[i] == cell.sign;
    proof.before_m3 += cell.sign * cell.volume_m3;
    proof.after_m3 += signs[i] * cell.volume_m3;
  }
  Evaluation evaluation(segmentation, work);
  evaluation.for_each_point([&](Vec3 p) {
    ++proof.points;
    evaluation.go_to(p);
    if (evaluation.is_in(before, before.root) != evaluation.is_in(after, after.root))
      ++proof.differing;
  });
  return proof;
}

}  // namespace oriel
