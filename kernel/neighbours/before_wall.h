#pragma once

#include "kernel/geometry/planar.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// Whether a point of the plan is in one of some pieces, each given by its outlines.
bool is_on_ground(std::span<const std::vector<Outline>> pieces, Vec3 point);

/// How far from a point, along a level direction of length 1, the first edge of the pieces lies
/// that the way crosses. Nothing if it crosses none within `reach_m`.
std::optional<double> first_crossing_m(std::span<const std::vector<Outline>> pieces, Vec3 from,
                                       Vec3 along, double reach_m);

}  // namespace oriel::detail
