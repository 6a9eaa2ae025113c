#include "kernel/segment/detail/nested_loops.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// A loop with what is needed to find the loops inside it.
struct LoopShape {
  int loop;
  double area;
  Box box;
  Outline points;  ///< filled in when asked for
};

bool is_within(const Box& inner, const Box& outer) {
  return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
         inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
}

class LoopNester {
 public:
  LoopNester(Section& section, Vec3 axis) : section_(section), axis_(axis) {}

  void run() {
    find_shapes();
    std::array<std::vector<int>, 2> larger;  // around air, around material
    for (int i = 0; i < std::ssize(shapes_); ++i) {
      const LoopShape& shape = shapes_[at(i)];
      add_region(shape.loop);
      const bool is_material = shape.area > 0;
      const int parent = parent_of(shape, larger[is_material ? 0 : 1]);
      larger[is_material ? 1 : 0].push_back(i);
      if (parent < 0) continue;
      Region& around = section_.regions[at(parent)];
      around.loops.push_back(shape.loop);
      around.area -= std::abs(shape.area);
    }
  }

  void add_region(int l) {
    const double area = section_.loops[at(l)].area;
    section_.regions.push_back({area > 0, {l}, std::abs(area)});
  }

 private:
  /// The largest first.
  void find_shapes() {
    shapes_.reserve(section_.loops.size());
    for (int l = 0; l < std::ssize(section_.loops); ++l) {
      shapes_.push_back({l, section_.loops[at(l)].area, {}, {}});
      for_each_crossing(section_, l, [&](const Crossing& c) { shapes_.back().box.grow(c.at); });
    }
    std::ranges::sort(shapes_, std::greater{}, [&](const LoopShape& s) {
      return std::pair(std::abs(s.area),
                       -section_.crossings[at(section_.loops[at(s.loop)].first)].edge);
    });
  }

  /// The smallest of the larger loops of the other kind that is around `inner`, or -1.
  int parent_of(const LoopShape& inner, const std::vector<int>& others) {
    for (std::size_t j = others.size(); j-- > 0;) {
      LoopShape& outer = shapes_[at(others[j])];
      if (is_within(inner.box, outer.box) && is_inside(inner, outer)) return others[j];
    }
    return -1;
  }

  /// Loops do not cross, so one point tells; the middle of the figure may lie in a loop further in,
  /// so it is asked from points of the loop itself until one is clear of the outer loop's own
  /// points.
  bool is_inside(const LoopShape& inner, LoopShape& outer) const {
    if (outer.points.empty()) outer.points = outline_of(section_, outer.loop);
    const int first = section_.loops[at(inner.loop)].first;
    int c = first;
    do {
      const Vec3 p = section_.crossings[at(c)].at;
      if (std::ranges::find(outer.points, p) == outer.points.end())
        return contains({&outer.points, 1}, axis_, p);
      c = section_.crossings[at(c)].next;
    } while (c != first);
    const Outline points = outline_of(section_, inner.loop);
    const auto middle = interior_point({&points, 1}, axis_);
    return middle && contains({&outer.points, 1}, axis_, *middle);
  }

  Section& section_;
  Vec3 axis_;
  std::vector<LoopShape> shapes_;
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
  for_each_crossing(section, loop, [&](const Crossing& c) { points.push_back(c.at); });
  return points;
}

}  // namespace oriel::detail
