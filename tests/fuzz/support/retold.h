#pragma once

#include "model/building.h"

#include <string>

namespace oriel::fuzz {

/// The same building, turned by a right angle about z: exact, since only signs and axes change.
Building turned_by_right_angle(Building building);

/// The same building, further away by whole metres, as a reader would read it.
Building moved_by_metres(Building building);

/// The same building with every polygon cut into triangles, no vertex added.
Building cut_into_triangles(const Building& building);

/// The building as a CityJSON file: a Solid or MultiSolid, or a MultiSurface if it is none.
/// Vertices are whole multiples of `scale_m`.
std::string cityjson_of(const Building& building, double scale_m);

}  // namespace oriel::fuzz
