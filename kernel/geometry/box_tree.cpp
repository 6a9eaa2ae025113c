#include "kernel/geometry/box_tree.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace oriel {

namespace {

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

int longest_axis(Vec3 reach) {
  if (reach.x >= reach.y && reach.x >= reach.z) return 0;
  return reach.y >= reach.z ? 1 : 2;
}

}  // namespace

BoxTree::BoxTree(std::vector<Box> boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (boxes.empty()) return;
  nodes_.resize(2 * std::bit_ceil(boxes.size()));
  build(boxes, 0, items_.size(), 1);
}

void BoxTree::build(const std::vector<Box>& boxes, std::size_t begin, std::size_t end,
                    std::size_t node) {
  Box& box = nodes_[node];
  for (std::size_t i = begin; i < end; ++i) box.grow(boxes[at(items_[i])]);
  if (end - begin == 1) return;
  const int axis = longest_axis(box.max - box.min);
  const std::size_t middle = (begin + end) / 2;
  const auto first = items_.begin();
  const auto place = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  std::nth_element(first + place(begin), first + place(middle), first + place(end),
                   [&](int i, int j) {
                     const Box &p = boxes[at(i)], &q = boxes[at(j)];
                     const double mine = along(p.min, axis) + along(p.max, axis);
                     const double theirs = along(q.min, axis) + along(q.max, axis);
                     return mine != theirs ? mine < theirs : i < j;
                   });
  build(boxes, begin, middle, 2 * node);
  build(boxes, middle, end, 2 * node + 1);
}

bool comes_near(const Box& box, Vec3 from, Vec3 to, double reach) {
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double start = along(from, axis), step = along(to, axis) - start;
    const double low = along(box.min, axis) - reach, high = along(box.max, axis) + reach;
    if (step == 0) {
      if (start < low || start > high) return false;
      continue;
    }
    const double first = (low - start) / step, second = (high - start) / step;
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return enter <= leave;
}

}  // namespace oriel
