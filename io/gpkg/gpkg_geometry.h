#pragma once

#include "model/vec3.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace oriel::detail {

/// Polygons as GeoPackage stores a geometry (GeoPackage 1.3, 2.1.3): a header with the box, then a
/// MultiPolygon Z of WKB, little-endian. `polygons` are lists of rings, the outer one first, which
/// are numbers of `points` and do not repeat their first; they are closed here. Rings of fewer
/// than three corners, and polygons whose outer ring is one, are left out. Empty without a
/// polygon. The number of the reference system is 0: set_reference_system() puts it in.
std::string gpkg_geometry(std::span<const std::vector<std::vector<int>>* const> polygons,
                          const std::vector<Vec3>& points, Box& box);

void set_reference_system(std::string& geometry, std::int32_t number);

}  // namespace oriel::detail
