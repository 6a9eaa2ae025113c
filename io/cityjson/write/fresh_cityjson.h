#pragma once

#include "io/cityjson/cityjson_source.h"
#include "model/building.h"

#include <vector>

namespace oriel::detail {

/// A new CityJSON 2.0 text of buildings that were not read from CityJSON: one Building each with
/// one geometry (a Solid, or a MultiSurface), lod "3" where it has none. Whole metres are its
/// translation; its scale is 0.001 if all coordinates are multiples of that, else 1e-6.
CityJsonSource fresh_cityjson(const std::vector<Building>& buildings);

}  // namespace oriel::detail
