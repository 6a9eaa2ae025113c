#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/building.h"
#include "kernel/model/segmentation.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// Input polygons as what is parallel to a plane.
class Panes {
 public:
  /// On a grid of `grid_m` (exact::on_grid).
  Panes(const Building& building, double grid_m);

  /// Where half of a feature's outline shows its surface, along the plane's normal from the plane.
  [[nodiscard]] std::optional<double> level_in(const Feature& feature, const Plane& plane) const;

 private:
  struct Pane {
    Vec3 area, middle;
  };
  void take_outline(const std::vector<int>& ring, Outline& outline) const;

  std::vector<Vec3> corners_;  ///< by vertex, on the grid
  std::vector<Pane> panes_;    ///< by Polygon::source
};

}  // namespace oriel::detail
