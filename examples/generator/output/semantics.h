#pragma once

#include "examples/generator/output/cityjson.h"
#include "examples/generator/output/json.h"

#include <string_view>
#include <vector>

namespace oriel::generator {

/// One surface of the semantics: the polygons of an object that are of one type.
struct SemanticSurface {
  int object = -1;
  /// "WallSurface", "RoofSurface", "GroundSurface", "OuterFloorSurface", "OuterCeilingSurface",
  /// "Window" or "Door".
  std::string_view type;
  /// Of an opening, the surface it is cut into, if it is there; else -1.
  int parent = -1;
  std::vector<int> children;
};

struct Surfaces {
  std::vector<SemanticSurface> surfaces;
  /// Parallel to the polygons asked for.
  std::vector<int> of_polygon;
};

/// The surfaces of these polygons of the body, in the order in which they occur.
Surfaces surfaces_of(const Body& body, const std::vector<int>& polygons);

/// Appends CityJSON's "semantics" object for a geometry made of these polygons of the building: one
/// semantic surface per object and type, openings as children of the surface they are cut into,
/// each with the object's id, label and subclass. A Solid's values are nested once more than a
/// MultiSurface's.
void append_semantics(Json& json, const Building& building, const std::vector<int>& polygons,
                      bool is_solid);

}  // namespace oriel::generator
