#pragma once

#include "kernel/model/building.h"

#include <optional>

namespace oriel::cli {

struct PolygonAt {
  /// Index into Building::polygons.
  std::size_t polygon = 0;
  double distance_m = 0;
};

/// The polygon that a point (in the input's coordinates) lies on: of those it is inside of, seen
/// along their normal, the one whose plane is nearest, of equal ones the first. Nothing if none is
/// nearer than a pick on a screen is off.
std::optional<PolygonAt> polygon_at(const Building& building, Vec3 point);

}  // namespace oriel::cli
