#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <optional>
#include <vector>

namespace oriel {

/// A piece of ground and the block on it.
struct UprightBlock {
  std::vector<Outline> outlines;  ///< z = 0, the interior to the left, the outer one first
  double ground_m = 0, top_m = 0;
};

/// The walls, tops and ground faces of blocks that do not touch each other: one body for each.
Building faces_of(const std::vector<UprightBlock>& blocks);

/// The solid that faces make; nothing if it does not close.
std::optional<Solid> block_solid(const Building& faces, const Tolerances& tolerances);

/// The solid that they make; nothing if it does not close.
std::optional<Solid> block_solid(const std::vector<UprightBlock>& blocks,
                                 const Tolerances& tolerances);

}  // namespace oriel
