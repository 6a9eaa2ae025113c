#pragma once

#include "io/json/json_scan.h"
#include "model/building.h"
#include "model/vec3.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace oriel {

/// CityJSON's transform: input coordinate = translate + scale × integer, per axis.
struct Transform {
  Vec3 scale{1, 1, 1};
  Vec3 translate;
};

/// The number of a geometry that is not there.
inline constexpr std::size_t kNoGeometry = static_cast<std::size_t>(-1);

/// Where a building's geometry stands in its text.
struct GeometryPlace {
  /// The number of the member of "CityObjects".
  std::size_t object = 0;
  /// The number of the element of its "geometry", or kNoGeometry.
  std::size_t geometry = 0;
};

/// The text that a CityJSON document was read from: valid JSON (simdjson parsed all of it), whose
/// root is an object with "CityObjects".
struct CityJsonSource {
  std::string text;
  Transform transform;
  /// True for a line of a CityJSONSeq, which takes its transform from the header line.
  bool is_feature = false;
  /// Where arrays of numbers stand in the text, ascending; none has to be there.
  std::vector<TextRange> arrays;
  /// Parallel to Document::buildings.
  std::vector<GeometryPlace> places;
  /// Of each of them the geometries that were joined to it, parallel to Building::installations.
  /// May be shorter.
  std::vector<std::vector<GeometryPlace>> joined{};
  /// By id of a building what is there at the level at which it was read besides its geometry:
  /// other geometries of its own, and those of its installations that do not share its polygons
  /// (Building::id is that of the installation then).
  std::multimap<std::string, Building> beside{};
};

}  // namespace oriel
