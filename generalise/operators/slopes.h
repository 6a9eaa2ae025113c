#pragma once

#include "kernel/model/vec3.h"

#include <cmath>
#include <numbers>

namespace oriel::detail {

/// What is steeper is a wall: 75 degrees, the default pack's steepest roof.
inline const double kSteepestRoof = std::cos(75 * std::numbers::pi / 180);

/// A roof, by the slope of its facet alone.
inline bool looks_up(Vec3 normal) { return normal.z > kSteepestRoof; }
/// A ground or ceiling, likewise.
inline bool looks_down(Vec3 normal) { return normal.z < -kSteepestRoof; }

}  // namespace oriel::detail
