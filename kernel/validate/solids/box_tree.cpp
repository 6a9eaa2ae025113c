#include "kernel/validate/solids/box_tree.h"

#include <numeric>
#include <utility>

namespace oriel::detail {

GridBoxTree::GridBoxTree(std::vector<GridBox> boxes)
    : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (!boxes_.empty()) build(0, boxes_.size());
}

std::size_t GridBoxTree::build(std::size_t from, std::size_t to) {
  const std::size_t number = nodes_.size();
  Node node{boxes_[order_[from]], from, to};
  const auto centre = [&](std::size_t i, std::size_t axis) {
    return boxes_[i].min[axis] + boxes_[i].max[axis];
  };
  MicrometrePoint least;
  MicrometrePoint most;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    least[axis] = most[axis] = centre(order_[from], axis);
    for (std::size_t i = from; i < to; ++i) {
      const GridBox& box = boxes_[order_[i]];
      node.box.min[axis] = std::min(node.box.min[axis], box.min[axis]);
      node.box.max[axis] = std::max(node.box.max[axis], box.max[axis]);
      least[axis] = std::min(least[axis], centre(order_[i], axis));
      most[axis] = std::max(most[axis], centre(order_[i], axis));
    }
  }
  nodes_.push_back(node);
  if (to - from <= kLeafSize) return number;
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (most[axis] - least[axis] > most[longest] - least[longest]) longest = axis;
  const std::size_t middle = from + (to - from) / 2;
  const auto at = [this](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(from), at(middle), at(to), [&](std::size_t i, std::size_t j) {
    return std::pair(centre(i, longest), i) < std::pair(centre(j, longest), j);
  });
  const std::size_t left = build(from, middle);
  const std::size_t right = build(middle, to);
  nodes_[number].left = left;
  nodes_[number].right = right;
  return number;
}

}  // namespace oriel::detail
