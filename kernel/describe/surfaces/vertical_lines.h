#pragma once

#include "kernel/describe/surfaces/surface_faces.h"
#include "kernel/geometry/planar.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// Outlines seen from above. Asking whether it holds a point costs a look at the edges beside the
/// point, not at all of them.
class PlanFigure {
 public:
  explicit PlanFigure(std::span<const OutlineView> outlines);

  [[nodiscard]] const Box& box() const { return box_; }
  /// Even-odd over all outlines; z is not looked at. Points on an outline may fall on either side.
  [[nodiscard]] bool contains(Vec3 point) const;

 private:
  struct PlanEdge {
    double from_x, from_y, to_x, to_y;
  };
  [[nodiscard]] std::size_t strip_of(double y) const;
  template <class Visit>
  void for_each_touch(std::span<const OutlineView> outlines, Visit visit) const;

  Box box_;
  /// Edges by the strips of equal width in y that they touch: those of strip s begin at first_[s].
  std::vector<PlanEdge> edges_;
  std::vector<int> first_;
};

/// Where a vertical line meets a face.
struct LineCrossing {
  double z = 0;
  int face = -1;
};

/// What lies straight above and below points: the faces that are not steep, in a grid seen from
/// above. Refers to the faces, which must outlive it.
class VerticalLines {
 public:
  explicit VerticalLines(const SurfaceFaces& faces);

  /// All crossings of the vertical line through `point`, from below; of equal heights by number.
  [[nodiscard]] std::vector<LineCrossing> at(Vec3 point) const;
  /// Of them the first above `z`.
  [[nodiscard]] std::optional<LineCrossing> next_above(Vec3 point, double z) const;
  /// Of them the last that is not above `z`.
  [[nodiscard]] std::optional<LineCrossing> next_below(Vec3 point, double z) const;

 private:
  /// A face that is not steep: its box seen from above and the heights it can be met at, which most
  /// faces of a cell are left out by, then what it is.
  struct FaceBox {
    double x0, x1, y0, y1, z0, z1;
    int face;
  };
  /// What else is needed of a face that a line may meet.
  struct Met {
    PlanFigure figure;
    Vec3 middle;
  };
  /// The cells that a box touches.
  struct Cells {
    int row0, row1, column0, column1;
  };
  [[nodiscard]] static FaceBox entry_of(const SurfaceFace& face, int number);
  void fill_cells();
  [[nodiscard]] int column_of(double x) const;
  [[nodiscard]] int row_of(double y) const;
  [[nodiscard]] Cells cells_of(const FaceBox& entry) const;
  [[nodiscard]] std::span<const int> cell_of(Vec3 point) const;
  [[nodiscard]] std::optional<LineCrossing> crossing(std::size_t entry, Vec3 point) const;

  const SurfaceFaces& faces_;
  Box box_;
  int side_ = 1;
  /// By z0, then by number.
  std::vector<FaceBox> entries_;
  /// Of entries, made when they are asked for: most faces are left out by their boxes.
  mutable std::vector<std::optional<Met>> met_;
  /// The entries whose box touches a cell, in their order, row by row: those of cell c begin at
  /// first_[c].
  std::vector<int> in_cells_;
  std::vector<int> first_;
};

}  // namespace oriel::detail
