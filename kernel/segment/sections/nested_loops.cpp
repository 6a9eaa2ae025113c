#include "kernel/segment/sections/nested_loops.h"

#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace oriel::detail {

namespace {

/// A loop by its size; of equal ones the first edge tells.
struct LoopSize {
  double size;
  int edge;
  int loop;
};

/// Most sections have no more loops.
constexpr std::size_t kFewLoops = 16;

class LoopNester {
 public:
  LoopNester(Section& section, Vec3 axis) : section_(section), axis_(axis) {}

  void run() {
    sort_loops();
    find_boxes();
    outlines_.resize(section_.loops.size());
    std::array<Few<int, kFewLoops>, 2> larger;  // regions around air, around material
    section_.regions.reserve(order_.size());
    for (int i = 0; i < std::ssize(order_); ++i) {
      const int l = order_[at(i)].loop;
      add_region(l);
      const bool is_material = section_.loops[at(l)].area > 0;
      const int parent = parent_of(l, larger[is_material ? 0 : 1]);
      larger[is_material ? 1 : 0].push_back(i);
      if (parent < 0) continue;
      Region& around = section_.regions[at(parent)];
      around.loops.push_back(l);
      around.area -= order_[at(i)].size;
    }
  }

  void add_region(int l) {
    const double area = section_.loops[at(l)].area;
    Region& region = section_.regions.emplace_back();
    region.is_material = area > 0;
    region.loops.push_back(l);
    region.area = std::abs(area);
  }

 private:
  /// The largest first.
  void sort_loops() {
    order_.reserve(section_.loops.size());
    for (int l = 0; l < std::ssize(section_.loops); ++l) {
      const SectionLoop& loop = section_.loops[at(l)];
      order_.push_back({std::abs(loop.area), section_.crossings[at(loop.first)].edge, l});
    }
    std::ranges::sort(order_, [](const LoopSize& p, const LoopSize& q) {
      return p.size != q.size ? p.size > q.size : p.edge < q.edge;
    });
  }

  void find_boxes() {
    boxes_.resize(section_.loops.size());
    for (const Crossing& c : section_.crossings) boxes_[at(c.loop)].grow(c.at);
  }

  /// Of the smallest of the larger loops of the other kind that is around loop `l` the region; or
  /// -1.
  int parent_of(int l, const Few<int, kFewLoops>& others) {
    for (std::size_t j = others.size(); j-- > 0;) {
      const int outer = order_[at(others[j])].loop;
      if (is_within(boxes_[at(l)], boxes_[at(outer)]) && is_inside(l, outer)) return others[j];
    }
    return -1;
  }

  /// Loops do not cross, so one point tells; the middle of the figure may lie in a loop further in,
  /// so it is asked from points of the loop itself until one is clear of the outer loop's own
  /// points.
  bool is_inside(int inner, int outer) {
    Outline& shape = outlines_[at(outer)];
    if (shape.empty()) shape = outline_of(section_, outer);
    const int first = section_.loops[at(inner)].first;
    int c = first;
    do {
      const Vec3 p = section_.crossings[at(c)].at;
      if (std::ranges::find(shape, p) == shape.end()) return contains({&shape, 1}, axis_, p);
      c = section_.crossings[at(c)].next;
    } while (c != first);
    const Outline points = outline_of(section_, inner);
    const auto middle = interior_point({&points, 1}, axis_);
    return middle && contains({&shape, 1}, axis_, *middle);
  }

  Section& section_;
  Vec3 axis_;
  Few<LoopSize, kFewLoops> order_;    ///< the loop of each region
  Few<Box, kFewLoops> boxes_;         ///< by loop
  Few<Outline, kFewLoops> outlines_;  ///< by loop, filled in when asked for
};

}  // namespace

void nest_loops(Section& section, Vec3 axis) {
  LoopNester nester(section, axis);
  if (section.loops.size() == 1)
    nester.add_region(0);
  else
    nester.run();
}

Outline outline_of(const Section& section, int loop) {
  Outline points;
  std::size_t size = 0;
  for_each_crossing(section, loop, [&](const Crossing&) { ++size; });
  points.reserve(size);
  for_each_crossing(section, loop, [&](const Crossing& c) { points.push_back(c.at); });
  return points;
}

}  // namespace oriel::detail
