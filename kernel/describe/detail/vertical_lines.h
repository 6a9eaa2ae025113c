#pragma once

#include "kernel/describe/detail/plan_figure.h"
#include "kernel/describe/detail/surface_faces.h"

#include <optional>
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
  /// Of them the first above `z`.
  [[nodiscard]] std::optional<LineCrossing> next_above(Vec3 point, double z) const;
  /// Of them the last that is not above `z`.
  [[nodiscard]] std::optional<LineCrossing> next_below(Vec3 point, double z) const;

 private:
  [[nodiscard]] int column_of(double x) const;
  [[nodiscard]] int row_of(double y) const;

  std::span<const SurfaceFace> faces_;
  std::vector<PlanFigure> figures_;
  Box box_;
  int side_ = 1;
  /// A face, its box seen from above and the heights it can be met at: what most faces of a cell
  /// are left out by.
  struct Entry {
    double x0, x1, y0, y1, z0, z1;
    int face;
  };
  [[nodiscard]] static Entry entry_of(const SurfaceFace& face, int number);
  [[nodiscard]] const std::vector<Entry>& cell_of(Vec3 point) const;
  [[nodiscard]] std::optional<LineCrossing> crossing(const Entry& entry, Vec3 point) const;

  /// The faces whose box touches a cell, row by row; in a cell by z0.
  std::vector<std::vector<Entry>> cells_;
};

}  // namespace oriel::detail
