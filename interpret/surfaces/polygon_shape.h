#pragma once

#include "model/building.h"
#include "model/vec3.h"

namespace oriel::rules {

/// The area vector of a polygon's outer ring (Newell): along its normal, as long as its area.
Vec3 area_vector(const Building& building, const Polygon& polygon);

/// The inclination of a direction: 0 looks up, 90 is vertical, 180 looks down; 90 for the zero
/// vector.
double inclination_deg(Vec3 direction);

/// The box of a polygon's outer ring.
Box box_of(const Building& building, const Polygon& polygon);

}  // namespace oriel::rules
