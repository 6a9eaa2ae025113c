#pragma once

#include "kernel/base/work.h"
#include "model/segmentation.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

/// Two leaves that became one (paper, Figure 8), as an operation with its inverse: the convex union
/// falls apart again along the plane `contact`, `first` behind it and `second` in front of it.
/// Leaves are named by the first cell they were made of.
struct LeafMerge {
  CellId first, second;
  PlaneId contact;
  /// What lies behind all of them is the union.
  std::vector<PlaneId> planes;
  double volume_m3 = 0;
};

/// The CSG tree of a segmentation, arranged anew: the same signed cells, few levels.
struct BalancedTree {
  /// As Segmentation::nodes. A leaf is a cell, or what merges made of it and others.
  std::vector<CsgNode> nodes;
  NodeId root;
  /// In the order in which they were done.
  std::vector<LeafMerge> merges;
};

/// Arranges the tree anew (paper section 6). Along the rest of a body, what was split off is put
/// into one union and one difference, the largest part first: (rest ∪ parts) ∖ holes. A part that
/// was cut off before a hole was filled, and reaches into it, stays outside of that difference,
/// which then is the rest of the next pair. So the tree is as deep as features are nested, not as
/// many as there are. It is the same body because (A ∖ H) ∪ P = (A ∪ P) ∖ H where P and H share no
/// inner point; that is asked of their boxes and split planes, to 1e-9 m, and what is not certain
/// stays in its order.
BalancedTree balance(const Segmentation& segmentation);

/// Merges convex leaves that are parts of one node, touch, and whose union is convex, the largest
/// ones first, if `labels`, by feature, agree; empty: all do. Leaves of the body itself merge with
/// none of a feature. The union is convex if each lies behind all planes of the other but the one
/// in which they touch, to 1e-6 m, and all corners of both lie in the planes of their facets, to
/// 1e-6 m: a merged leaf is what lies behind its planes.
void merge_touching(BalancedTree& tree, const Segmentation& segmentation,
                    const std::vector<std::string>& labels = {});

/// How long the ways are in a CSG tree.
struct TreeFigures {
  std::size_t leaves = 0;
  std::size_t inner = 0;
  std::size_t depth = 0;     ///< edges from the root to the deepest leaf
  double weighted_path = 0;  ///< the mean depth of leaves by volume
};
TreeFigures figures_of(const Segmentation& segmentation);
TreeFigures figures_of(const BalancedTree& tree, const Segmentation& segmentation);

/// What was compared to see that two trees are one body.
struct BalanceProof {
  /// Every cell is in the tree once, by itself or in a merge, with its sign.
  bool has_same_cells = false;
  /// The sum of signed volumes, of the segmentation and of the tree, in the order of cells: equal
  /// to the last bit if the cells are.
  double before_m3 = 0, after_m3 = 0;
  /// Points close to facets of all cells, on both sides, at which both trees were evaluated by
  /// union and difference, merged leaves by their planes.
  std::size_t points = 0, differing = 0;

  [[nodiscard]] bool holds() const {
    return has_same_cells && before_m3 == after_m3 && differing == 0;
  }
};
BalanceProof prove(const BalancedTree& tree, const Segmentation& segmentation);

/// The same, its work counted: once that is used up no more points are asked.
BalanceProof prove(const BalancedTree& tree, const Segmentation& segmentation, Work& work);

}  // namespace oriel
