#pragma once

#include "model/vec3.h"

#include <cmath>
#include <numbers>

/// Directions in degrees, as tables have them, and facets told apart by their slope.
namespace oriel {

inline constexpr double kDegree_rad = std::numbers::pi / 180;

/// Between a direction and straight up: 0 looks up, 90 is level, 180 looks down.
inline double inclination_deg(Vec3 direction) {
  return std::atan2(std::hypot(direction.x, direction.y), direction.z) * 180 / std::numbers::pi;
}

/// Clockwise from north, 0 to 360. Who asks says how near to straight up or down a direction has
/// none.
inline double azimuth_deg(Vec3 direction) {
  const double azimuth = std::atan2(direction.x, direction.y) * 180 / std::numbers::pi;
  return azimuth < 0 ? azimuth + 360 : azimuth;
}

/// Of a normal upwards: a facet that is steeper is a wall, 75 degrees, the default pack's steepest
/// roof.
inline const double kSteepestRoof = std::cos(75 * kDegree_rad);

/// A roof, by the slope of its facet alone.
inline bool looks_up(Vec3 normal) { return normal.z > kSteepestRoof; }
/// A ground or ceiling, likewise.
inline bool looks_down(Vec3 normal) { return normal.z < -kSteepestRoof; }
/// A wall, likewise.
inline bool looks_aside(Vec3 normal) { return std::abs(normal.z) <= kSteepestRoof; }

}  // namespace oriel
