#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/vec3.h"

#include <optional>

namespace oriel {

/// A block under a gabled roof, whose ridge runs over the middle of its ground.
struct GabledBlock {
  /// Four corners, counter-clockwise, z = 0: the eaves run along the first and the third edge,
  /// which are parallel.
  Outline outline;
  double ground_m = 0, eaves_m = 0, ridge_m = 0;
};

/// An outline turned so that the edges along which eaves can run come first; nothing unless it has
/// four corners and opposite edges, along `ridge` to 10 degrees, that are parallel to half a degree
/// and no shorter than the others.
std::optional<Outline> under_ridge(const Outline& outline, Vec3 ridge);

/// Its walls, roof and ground. The ends of the ridge are on the grid.
Building faces_of(const GabledBlock& block, double grid_m);

}  // namespace oriel
