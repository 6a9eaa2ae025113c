#pragma once

#include "kernel/base/text/numbers.h"
#include "kernel/geometry/boxes.h"
#include "model/vec3.h"

#include <vector>

namespace oriel {

/// Boxes in a balanced tree, for searches that look at few of them: each node's items are halved
/// along the longest side of its box. Takes O(n log n) to make; coordinates are compared, never
/// computed with, so a search is exact.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);

  /// Visits the numbers of all boxes that `reaches` says yes to; it must say yes to every box that
  /// holds one that it says yes to.
  template <class Reaches, class Visit>
  void search(Reaches reaches, Visit visit) const {
    if (!items_.empty()) search_node(0, items_.size(), 1, reaches, visit);
  }

  /// Visits the numbers of all boxes that overlap `box`, always in the same order.
  template <class Visit>
  void for_each_overlap(const Box& box, Visit visit) const {
    search([&](const Box& other) { return overlap(box, other); }, visit);
  }

 private:
  /// The node of items_[begin…end): its box is nodes_[node], its halves are 2·node and 2·node + 1.
  template <class Reaches, class Visit>
  void search_node(std::size_t begin, std::size_t end, std::size_t node, Reaches& reaches,
                   Visit& visit) const {
    if (!reaches(nodes_[node])) return;
    if (end - begin == 1) return visit(items_[begin]);
    const std::size_t middle = (begin + end) / 2;
    search_node(begin, middle, 2 * node, reaches, visit);
    search_node(middle, end, 2 * node + 1, reaches, visit);
  }
  void build(const std::vector<Box>& boxes, std::size_t begin, std::size_t end, std::size_t node);

  std::vector<int> items_;
  std::vector<Box> nodes_;
};

/// True if the segment comes as near as `reach` to the box, or nearly so.
bool comes_near(const Box& box, Vec3 from, Vec3 to, double reach);

}  // namespace oriel
