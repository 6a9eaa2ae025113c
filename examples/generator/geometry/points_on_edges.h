#pragma once

#include "examples/generator/geometry/point.h"

#include <array>
#include <vector>

namespace oriel::generator {

/// Finds the points that lie on an edge. Exact; fast for edges along an axis, which nearly all are.
class PointsOnEdges {
 public:
  /// `points` must be distinct and outlive this.
  explicit PointsOnEdges(const std::vector<Point>& points);

  /// Appends the points strictly between points `from` and `to`, in that direction.
  void append(int from, int to, std::vector<int>& found) const;

 private:
  void append_along(std::size_t axis, int from, int to, std::vector<int>& found) const;
  void append_slanted(int from, int to, std::vector<int>& found) const;

  const std::vector<Point>& points_;
  /// Per axis, all points in the order of their other two coordinates, then of this one: what lies
  /// between two points of a line along the axis stands between them here. And their places in it.
  std::array<std::vector<int>, 3> order_, place_;
};

}  // namespace oriel::generator
