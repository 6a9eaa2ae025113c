#pragma once

#include "examples/generator/house/body.h"
#include "examples/generator/random.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::generator {

/// What a file tells of a building: its solid with semantic surfaces (openings as Window and Door,
/// every object's name and class) and BuildingInstallation children, or the bare solid.
enum class Content { labelled, stripped };

/// A body under its CityObject's id. Vertices are relative to `origin`.
struct Building {
  std::string id;
  Body body;
  Point origin;
};

/// The same body with its polygons, vertices and ring starts in random order.
Body shuffled(const Body& body, Random& random);

/// SIG3D's code of an installation.
std::string_view function_code(Class kind);

/// Per object, its polygons and those of the objects that are part of it.
std::vector<std::vector<int>> polygons_by_object(const Body& body);

/// A CityJSON 2.0 file; integer vertices in micrometres.
std::string cityjson(const Building& building, Content content);

/// The first line of a CityJSONSeq whose features share the origin, and the line of one feature,
/// both with their line break.
std::string cityjson_header(Point origin);
std::string cityjson_feature(const Building& building, Content content);

}  // namespace oriel::generator
