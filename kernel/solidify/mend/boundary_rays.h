#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <optional>
#include <span>

namespace oriel::detail {

/// The polygons that bound what the pieces of a soup enclose (PolygonCells::is_boundary), as rays
/// meet them. All rays have one direction, which no wall, roof or edge of a building has.
class BoundaryRays {
 public:
  /// Polygons that are looked at are counted in `work`, which must outlive it.
  BoundaryRays(const Soup& soup, std::span<const PolygonShape> shapes, const PolygonCells& cells,
               Work& work);

  /// Visits the polygons that the ray from a point (grid units) runs through. Takes the logarithm
  /// of the polygons, and those near the ray.
  template <class Visit>
  void for_each_hit(Vec3 eye, Visit visit) const {
    const Vec3 far = eye + reach_ * kDirection;
    tree_.search([&](const Box& box) { return comes_near(box, eye, far, 0); },
                 [&](int item) {
                   work_.add(std::ssize(soup_.corners_of(polygons_[at(item)])));
                   if (is_hit(polygons_[at(item)], eye)) visit(polygons_[at(item)]);
                 });
  }

  /// How many of the pieces have the point in what they enclose: 0 outside of all.
  [[nodiscard]] int depth_of(Vec3 eye) const;

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }
  [[nodiscard]] bool is_hit(int polygon, Vec3 eye) const;

  static constexpr Vec3 kDirection{0.3127716, 0.5418393, 0.7801215};

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  const PolygonCells& cells_;
  Work& work_;
  Numbers polygons_;  ///< of the boundary
  double reach_ = 0;  ///< beyond all of them from any of them
  BoxTree tree_;
};

}  // namespace oriel::detail
