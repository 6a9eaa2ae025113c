#pragma once

#include "kernel/describe/detail/plan_figure.h"
#include "kernel/describe/detail/surface_faces.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// Where a vertical line meets a face.
struct LineCrossing {
  double z = 0;
  int face = -1;
};

/// What lies straight above and below points: the faces that are not steep, in a grid seen from
/// above. Refers to the faces, which must outlive it.
class VerticalLines {
 public:
  explicit VerticalLines(std::span<const SurfaceFace> faces);

  /// All crossings of the vertical line through `point`, from below; of equal heights by number.
  [[nodiscard]] std::vector<LineCrossing> at(Vec3 point) const;

 private:
  [[nodiscard]] int column_of(double x) const;
  [[nodiscard]] int row_of(double y) const;

  std::span<const SurfaceFace> faces_;
  std::vector<PlanFigure> figures_;
  Box box_;
  int side_ = 1;
  /// A face and its box seen from above: what most faces of a cell are left out by.
  struct Entry {
    double x0, x1, y0, y1;
    int face;
  };
  /// The faces whose box touches a cell, row by row.
  std::vector<std::vector<Entry>> cells_;
};

}  // namespace oriel::detail
