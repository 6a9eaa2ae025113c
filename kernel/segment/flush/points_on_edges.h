#pragma once

#include "kernel/model/vec3.h"
#include "kernel/segment/boundary/reach.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Points of a plane, found where they lie on edges: the T-vertices between polygons that were
/// drawn one by one.
class PointsOnEdges {
 public:
  /// A point is on an edge if it is no further from it than `slack_m`.
  PointsOnEdges(const std::vector<Vec3>& points, ReachAxes axes, double slack_m);

  /// Indices of the points on the edge between two points, without these, in the order from `from`
  /// to `to`. Looks at the points in the edge's strip along u or v, whichever has fewer.
  [[nodiscard]] std::vector<int> between(int from, int to) const;

 private:
  /// Indices of the points, and their coordinate along one axis, ascending.
  struct Strip {
    std::vector<double> coordinates;
    std::vector<int> points;
    [[nodiscard]] std::pair<std::size_t, std::size_t> range(double low, double high) const;
  };
  [[nodiscard]] Strip strip_along(Vec3 axis) const;

  const std::vector<Vec3>& points_;
  ReachAxes axes_;
  double slack_m_;
  Strip by_u_, by_v_;
};

}  // namespace oriel::detail
