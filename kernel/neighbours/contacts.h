#pragma once

#include "kernel/neighbours/neighbours.h"
#include "kernel/neighbours/standing_building.h"

#include <vector>

namespace oriel::detail {

/// Where one building touches another, whose frame lies at `moved_m` in that of the first. With
/// `walls`, the other's walls that lie against the first are added there.
BuildingContact contact_between(const StandingBuilding& one, const StandingBuilding& other,
                                Vec3 moved_m, std::vector<NeighbourWall>* walls);

/// The ground that both cover; 0 if one lies above the other.
double common_ground_m2(const StandingBuilding& one, const StandingBuilding& other, Vec3 moved_m);

}  // namespace oriel::detail
