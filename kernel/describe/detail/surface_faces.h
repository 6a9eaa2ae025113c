#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/building.h"
#include "kernel/model/solid.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

/// A polygon or facet as a figure in space. Refers to the points of its SurfaceFaces.
struct SurfaceFace {
  /// Outer outline first.
  std::span<const OutlineView> outlines;
  /// Unit normal by the order of the corners; 0 for a figure without area.
  Vec3 normal;
  double area_m2 = 0;
  Box box;

  /// Its plane is so steep (within 5 degrees of vertical) that up and down mean nothing.
  [[nodiscard]] bool is_steep() const;
  /// The mean of the outer outline's corners. Corners of a polygon lie off its plane by
  /// millimetres: the plane goes through their mean.
  [[nodiscard]] Vec3 mean() const;
  /// A point inside, on the plane.
  [[nodiscard]] Vec3 middle() const;
};

/// The height of a face's plane over a point in plan; the face must not be vertical. `on_plane` is
/// a point of its plane.
double z_at(const SurfaceFace& face, Vec3 on_plane, Vec3 point);

/// The faces of a building or a solid, with their points in one piece of memory.
class SurfaceFaces {
 public:
  explicit SurfaceFaces(const Building& building);
  explicit SurfaceFaces(const Solid& solid);
  SurfaceFaces(const SurfaceFaces&) = delete;
  SurfaceFaces& operator=(const SurfaceFaces&) = delete;

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  [[nodiscard]] const SurfaceFace& operator[](std::size_t face) const { return faces_[face]; }
  [[nodiscard]] auto begin() const { return faces_.begin(); }
  [[nodiscard]] auto end() const { return faces_.end(); }

 private:
  template <class Figures, class RingsOf, class PointAt>
  void take(const Figures& figures, RingsOf rings_of, PointAt point_at);

  std::vector<Vec3> points_;
  std::vector<OutlineView> outlines_;
  std::vector<SurfaceFace> faces_;
};

/// The sides of the smallest rectangle around the face in its plane, the longer one first.
struct Sides {
  double a_m = 0;
  double b_m = 0;
};
Sides sides_of(const SurfaceFace& face);

}  // namespace oriel::detail
