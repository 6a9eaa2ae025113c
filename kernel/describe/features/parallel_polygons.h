#pragma once

#include "model/building.h"
#include "model/segmentation.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// Input polygons as what is parallel to a plane. Refers to the building, which must outlive it.
class ParallelPolygons {
 public:
  /// On a grid of `grid_m` (exact::on_grid).
  ParallelPolygons(const Building& building, double grid_m);

  /// Where half of a feature's outline shows its surface, along the plane's normal from the plane.
  [[nodiscard]] std::optional<double> level_in(const Feature& feature, const Plane& plane) const;

 private:
  struct ParallelPolygon {
    const Polygon* polygon = nullptr;
    bool is_measured = false;
    Vec3 area, middle;
  };
  void measure(ParallelPolygon& polygon) const;
  /// The place of its least corner (is_lesser).
  [[nodiscard]] std::size_t least_of(std::span<const int> ring) const;

  std::vector<Vec3> corners_;  ///< by vertex, on the grid
  /// By Polygon::source; measured when they are asked for, as many lie in no feature.
  mutable std::vector<ParallelPolygon> polygons_;
};

}  // namespace oriel::detail
