#pragma once

#include "model/building.h"

#include <vector>

namespace oriel {

/// A building in an order that its geometry alone decides, whatever order it was read in: vertices
/// by their coordinates, each ring from its least corner on, inner rings and polygons by their
/// corners. What cannot be told apart (polygons with the same rings) comes in reading order.
/// Installations stay behind the building's own polygons; Building::repeats are left out.
struct CanonicalOrder {
  explicit CanonicalOrder(const Building& read);

  Building building;
  /// By Polygon::source of `building`: the number that the polygon was read with; and back.
  std::vector<int> to_reading, from_reading;
};

}  // namespace oriel
