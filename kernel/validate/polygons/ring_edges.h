#pragma once

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/validate/polygons/flat_polygon.h"

#include <cstddef>
#include <vector>

namespace oriel::detail {

/// An edge of a ring, from its point `at` to the next.
struct FlatEdge {
  std::size_t ring;
  std::size_t at;
  FlatPoint from;
  FlatPoint to;
};

inline std::vector<FlatEdge> edges_of(const std::vector<FlatPoint>& ring, std::size_t number) {
  std::vector<FlatEdge> edges;
  edges.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    edges.push_back({number, i, ring[i], ring[(i + 1) % ring.size()]});
  return edges;
}

/// The box of an edge or ring in the plane.
inline Box flat_box(const std::vector<FlatPoint>& points) {
  Box box;
  for (const FlatPoint& p : points)
    box.grow({static_cast<double>(p[0]), static_cast<double>(p[1]), 0});
  return box;
}

/// Calls visit(i, j), i < j, for all boxes that overlap, until it returns false.
template <class Visit>
void for_each_pair(const std::vector<Box>& boxes, const Visit& visit) {
  // Below this trying all pairs takes less than making a tree.
  constexpr std::size_t kFew = 24;
  if (boxes.size() <= kFew) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (overlap(boxes[i], boxes[j]) && !visit(i, j)) return;
    return;
  }
  const BoxTree tree(boxes);
  bool goes_on = true;
  for (std::size_t i = 0; i < boxes.size() && goes_on; ++i)
    tree.for_each_overlap(boxes[i], [&](int j) {
      if (goes_on && static_cast<int>(i) < j) goes_on = visit(i, at(j));
    });
}

}  // namespace oriel::detail
