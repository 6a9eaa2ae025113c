#pragma once

#include "model/vec3.h"

#include <string>
#include <vector>

namespace oriel {

/// An area of the plan, z = 0: the outer outline counter-clockwise, then holes clockwise.
using GroundArea = std::vector<std::vector<Vec3>>;

/// The areas of roads, parcels and the like in a file, in its coordinates.
///
/// - GeoJSON (RFC 7946): polygons, and lines as strips as wide as the property `width` of their
///   feature says, in metres, or 0.1 m. Points, and features without geometry, have no area.
/// - CityJSON: surfaces of the objects Road, Railway, TransportSquare, Waterway, WaterBody, LandUse
///   and PlantCover that are not steep, seen from above.
///
/// Throws InputError: E101 it cannot be read, E103 or E104 it is no JSON, E190 it is neither, has
/// no area, or something is wrong with one of its features: then nobody knows what is to be kept
/// free.
std::vector<GroundArea> read_ground_areas(const std::string& file);

}  // namespace oriel
