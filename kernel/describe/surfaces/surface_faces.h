#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/solid.h"

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

/// The faces of a building or a solid, with their points in one piece of memory. A face is made
/// when it is asked for, as few of a building's are. Refers to the building or the solid, which
/// must outlive it.
class SurfaceFaces {
 public:
  explicit SurfaceFaces(const Building& building);
  explicit SurfaceFaces(const Solid& solid);
  SurfaceFaces(const SurfaceFaces&) = delete;
  SurfaceFaces& operator=(const SurfaceFaces&) = delete;

  [[nodiscard]] std::size_t size() const { return faces_.size(); }
  [[nodiscard]] const SurfaceFace& operator[](std::size_t face) const {
    if (!is_made_[face]) make(face);
    return faces_[face];
  }
  /// Told without making it: its outer outline lies in a plane across x or y. It is steep then.
  [[nodiscard]] bool is_upright(std::size_t face) const { return is_upright_[face] != 0; }
  /// The least and the greatest height of all outer outlines; low > high if there are none.
  [[nodiscard]] double low_m() const { return low_m_; }
  [[nodiscard]] double high_m() const { return high_m_; }

 private:
  void make(std::size_t face) const;
  template <class Figures, class RingsOf, class PointAt>
  void survey(const Figures& figures, RingsOf rings_of, PointAt point_at);
  template <class Rings, class PointAt>
  void take(SurfaceFace& face, const Rings& rings, PointAt point_at) const;

  const Building* building_ = nullptr;
  const Solid* solid_ = nullptr;
  double low_m_ = Box::kInfinity, high_m_ = -Box::kInfinity;
  std::vector<char> is_upright_;
  // There is room for all before the first is made, so that none moves.
  mutable std::vector<Vec3> points_;
  mutable std::vector<OutlineView> outlines_;
  mutable std::vector<SurfaceFace> faces_;
  mutable std::vector<char> is_made_;
};

/// The sides of the smallest rectangle around the face in its plane, the longer one first.
struct RectangleSides {
  double a_m = 0;
  double b_m = 0;
};
RectangleSides sides_of(const SurfaceFace& face);

}  // namespace oriel::detail
