#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/validate/solids/shell_checks.h"

#include <array>
#include <span>
#include <vector>

namespace oriel::detail {

/// A shell that passed its judgement, as a body: its triangles seen counter-clockwise from outside,
/// also those of a cavity.
class ClosedSurface {
 public:
  ClosedSurface(const SnappedBuilding& building, const JudgedShell& shell);

  /// +1 if the shell's own polygons are counter-clockwise seen from outside, -1 if clockwise.
  [[nodiscard]] int orientation() const { return orientation_; }
  [[nodiscard]] const std::vector<MicrometreTriangle>& triangles() const { return triangles_; }
  /// Distinct corners, and triangles that number them.
  [[nodiscard]] const std::vector<MicrometrePoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<std::array<int, 3>>& corners() const { return corners_; }
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] const BoxTree& tree() const { return tree_; }

  /// True if `point`, which is not on the surface, is inside.
  [[nodiscard]] bool contains(const MicrometrePoint& point) const;

 private:
  std::vector<MicrometrePoint> points_;
  std::vector<std::array<int, 3>> corners_;
  std::vector<MicrometreTriangle> triangles_;
  Box box_;
  BoxTree tree_;
  int orientation_ = 0;
};

/// How two bodies lie to each other.
struct SurfaceRelation {
  /// The same set of points.
  bool are_alike = false;
  /// Their interiors have points in common.
  bool do_overlap = false;
  /// The second has no point outside the first.
  bool is_second_inside = false;
  /// Their surfaces have an area in common.
  bool share_a_face = false;
  /// Their surfaces have a point in common.
  bool do_touch = false;
};

/// Exact. Bodies whose surfaces do not meet, or pierce each other, take near-linear time; those
/// that touch are put to CGAL's Nef polyhedra, which take about a millisecond a triangle.
SurfaceRelation relate(const ClosedSurface& first, const ClosedSurface& second, Work& work);

/// The number of pieces of the interior of `outer` without `cavities`, which lie inside it and
/// share no area with it or each other.
int count_pieces(const ClosedSurface& outer, std::span<const ClosedSurface* const> cavities,
                 Work& work);

}  // namespace oriel::detail
