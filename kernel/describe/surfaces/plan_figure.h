#pragma once

#include "kernel/geometry/planar.h"

#include <cstddef>
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

}  // namespace oriel::detail
