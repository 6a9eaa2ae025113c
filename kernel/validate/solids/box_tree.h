#pragma once

#include "kernel/validate/solids/predicates.h"

#include <algorithm>
#include <span>
#include <vector>

namespace oriel::detail {

/// A box of whole coordinates, its faces part of it.
struct GridBox {
  MicrometrePoint min;
  MicrometrePoint max;
};

inline bool overlap(const GridBox& p, const GridBox& q) {
  for (std::size_t i = 0; i < 3; ++i)
    if (p.max[i] < q.min[i] || q.max[i] < p.min[i]) return false;
  return true;
}

inline GridBox box_of(std::span<const MicrometrePoint> points) {
  GridBox box{points[0], points[0]};
  for (const MicrometrePoint& p : points)
    for (std::size_t i = 0; i < 3; ++i) {
      box.min[i] = std::min(box.min[i], p[i]);
      box.max[i] = std::max(box.max[i], p[i]);
    }
  return box;
}

/// A tree of boxes: each node's items are halved along the longest axis of their centres.
class GridBoxTree {
 public:
  explicit GridBoxTree(std::vector<GridBox> boxes);

  /// Calls visit(i) for every box that overlaps `box`, in a fixed order.
  template <class Visit>
  void for_each_overlap(const GridBox& box, const Visit& visit) const {
    if (!nodes_.empty()) descend(0, box, visit);
  }

 private:
  struct Node {
    GridBox box;
    std::size_t from, to;
    /// Numbers of the two halves; 0 in a leaf.
    std::size_t left = 0, right = 0;
  };
  static constexpr std::size_t kLeafSize = 4;

  std::size_t build(std::size_t from, std::size_t to);

  template <class Visit>
  void descend(std::size_t number, const GridBox& box, const Visit& visit) const {
    const Node& node = nodes_[number];
    if (!overlap(node.box, box)) return;
    if (node.left != 0) {
      descend(node.left, box, visit);
      descend(node.right, box, visit);
      return;
    }
    for (std::size_t i = node.from; i < node.to; ++i)
      if (overlap(boxes_[order_[i]], box)) visit(order_[i]);
  }

  std::vector<GridBox> boxes_;
  std::vector<std::size_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace oriel::detail
