#pragma once

#include "examples/generator/cityjson.h"
#include "examples/generator/json.h"

#include <vector>

namespace oriel::generator {

/// Appends CityJSON's "semantics" object for a geometry made of these polygons of the building: one
/// semantic surface per object and type, openings as children of the surface they are cut into,
/// each with the object's id, label and subclass. A Solid's values are nested once more than a
/// MultiSurface's.
void append_semantics(Json& json, const Building& building, const std::vector<int>& polygons,
                      bool is_solid);

}  // namespace oriel::generator
