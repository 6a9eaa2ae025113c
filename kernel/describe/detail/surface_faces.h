#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/building.h"
#include "kernel/model/solid.h"

#include <vector>

namespace oriel::detail {

/// A polygon or facet as a figure in space.
struct SurfaceFace {
  /// Outer outline first.
  std::vector<Outline> outlines;
  /// Unit normal by the order of the corners; 0 for a figure without area.
  Vec3 normal;
  double area_m2 = 0;
  /// A point inside, on the plane.
  Vec3 middle;
  Box box;

  /// Its plane is so steep (within 5 degrees of vertical) that up and down mean nothing.
  [[nodiscard]] bool is_steep() const;
  /// The height of its plane over a point in plan; the face must not be vertical.
  [[nodiscard]] double z_at(Vec3 point) const;
};

std::vector<SurfaceFace> faces_of(const Building& building);
std::vector<SurfaceFace> faces_of(const Solid& solid);

/// The sides of the smallest rectangle around the face in its plane, the longer one first.
struct Sides {
  double a_m = 0;
  double b_m = 0;
};
Sides sides_of(const SurfaceFace& face);

}  // namespace oriel::detail
