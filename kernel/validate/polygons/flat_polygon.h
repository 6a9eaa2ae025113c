#pragma once

#include "kernel/validate/polygons/snapped.h"

#include <array>
#include <vector>

namespace oriel::detail {

/// A polygon seen along the axis nearest to its normal: exact, as coordinates stay what they are.
struct FlatPolygon {
  /// Coordinates by ring and place in the ring, the outer ring counter-clockwise.
  std::vector<std::vector<FlatPoint>> rings;
  /// The direction it is seen against, one of ±x, ±y, ±z.
  Vec3 axis;
};

/// `normal` is that of the polygon, of either sign.
FlatPolygon flat_polygon(const SnappedBuilding& building, const SnappedPolygon& polygon,
                         Vec3 normal);

/// +1 if the ring runs counter-clockwise, -1 if clockwise, 0 if it has no area.
int orientation(const std::vector<FlatPoint>& ring);

/// +1 if the point is inside the ring, -1 outside, 0 on it. The ring must not cross itself.
int place_in(const FlatPoint& point, const std::vector<FlatPoint>& ring);

/// True if rings p and q, which touch in `point` and nowhere overlap, run through each other there.
bool cross_at(const FlatPoint& point, const std::vector<FlatPoint>& p,
              const std::vector<FlatPoint>& q);

}  // namespace oriel::detail
