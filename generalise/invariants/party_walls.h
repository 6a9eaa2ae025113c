#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/building.h"
#include "kernel/model/solid.h"

#include <span>
#include <vector>

namespace oriel {

/// A wall of another building, in the frame of the building that it may stand against.
struct PartyWall {
  std::vector<detail::Outline> outlines;  ///< the outer one first
  Vec3 normal;                            ///< out of the other building
};

/// The upright polygons of those of `buildings` with another id that a facet of `solid`, which is
/// `building`'s, lies against: it looks the opposite way, no more than a centimetre off, and they
/// overlap.
std::vector<PartyWall> party_walls(const Building& building, const Solid& solid,
                                   std::span<const Building> buildings);

/// The area of the solid's facets that lies against the walls.
double shared_m2(const Solid& solid, const std::vector<PartyWall>& walls);

}  // namespace oriel
