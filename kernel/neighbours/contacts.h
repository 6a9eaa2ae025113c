#pragma once

#include "kernel/neighbours/neighbours.h"
#include "kernel/neighbours/standing_building.h"

#include <vector>

namespace oriel::detail {

/// Where one building touches another. With `walls`, the other's walls that lie against the first
/// are added there, in the frame of the first.
BuildingContact contact_between(const ShapedBuilding& one, const ShapedBuilding& other,
                                std::vector<NeighbourWall>* walls);

/// The ground that both cover; 0 if one lies above the other.
double common_ground_m2(const ShapedBuilding& one, const ShapedBuilding& other);

}  // namespace oriel::detail
