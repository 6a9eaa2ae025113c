#pragma once

#include "model/building.h"
#include "oriel/result.h"

#include <vector>

namespace oriel {

/// Where storeys begin, in metres over the origin of the building's frame, from below: the foot of
/// the building, then half-way between the openings of a storey and those of the next one. Nothing
/// for a building that has no openings in storeys, or was not segmented. Only cuts through a
/// picture are made by it.
std::vector<double> storey_floors(const Building& building, const PipelineResult& result);

}  // namespace oriel
