#pragma once

#include "kernel/validate/polygons/flat_polygon.h"
#include "kernel/validate/solids/box_tree.h"

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
inline GridBox flat_box(const std::vector<FlatPoint>& points) {
  GridBox box{{points[0][0], points[0][1], 0}, {points[0][0], points[0][1], 0}};
  for (const FlatPoint& p : points)
    for (std::size_t i = 0; i < 2; ++i) {
      box.min[i] = std::min(box.min[i], p[i]);
      box.max[i] = std::max(box.max[i], p[i]);
    }
  return box;
}

/// Calls visit(i, j), i < j, for all boxes that overlap, until it returns false.
template <class Visit>
void for_each_pair(const std::vector<GridBox>& boxes, const Visit& visit) {
  // Below this trying all pairs takes less than making a tree.
  constexpr std::size_t kFew = 24;
  if (boxes.size() <= kFew) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t j = i + 1; j < boxes.size(); ++j)
        if (overlap(boxes[i], boxes[j]) && !visit(i, j)) return;
    return;
  }
  const GridBoxTree tree(boxes);
  bool goes_on = true;
  for (std::size_t i = 0; i < boxes.size() && goes_on; ++i)
    tree.for_each_overlap(boxes[i], [&](std::size_t j) {
      if (goes_on && i < j) goes_on = visit(i, j);
    });
}

}  // namespace oriel::detail
