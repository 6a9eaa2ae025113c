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
  explicit PlanFigure(std::span<const Outline> outlines);

  [[nodiscard]] const Box& box() const { return box_; }
  /// Even-odd over all outlines; z is not looked at. Points on an outline may fall on either side.
  [[nodiscard]] bool contains(Vec3 point) const;

 private:
  struct Edge {
    Vec3 from, to;
  };
  [[nodiscard]] std::size_t strip_of(double y) const;

  Box box_;
  /// Edges by the strips of equal width in y that they touch.
  std::vector<std::vector<Edge>> strips_;
};

}  // namespace oriel::detail
