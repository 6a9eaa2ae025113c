#pragma once

#include <string>

namespace oriel {

/// Something with geometry that is not among the buildings of a file.
struct UnreadObject {
  /// Of CityGML its gml:id, which may be empty.
  std::string id;
  /// The type of its CityObject, of CityGML the name of its element; "GeometryInstance" for a
  /// building that has template geometry only.
  std::string type;
};

}  // namespace oriel
