#pragma once

#include "kernel/io/document.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace oriel {

/// Something with geometry that is not among the buildings of a document.
struct UnreadObject {
  std::string id;
  /// The type of its CityObject, or "GeometryInstance" for a building that has template geometry
  /// only.
  std::string type;
};

/// What stands in a record besides the buildings that were read of it.
struct ObjectSurvey {
  /// In the order of the file. Installations that share the polygons of their building
  /// (`oriel_geometry`) are none.
  std::vector<UnreadObject> unread;
  /// All levels of detail of buildings and parts, sorted as texts.
  std::set<std::string> lods;
  /// Of each building of the document the number of its family: those that are connected by parents
  /// and children have the same.
  std::vector<std::size_t> families;
};

/// Looks through the text of a document. Of CityGML only the families are known: a record is one;
/// of meshes each building is its own.
ObjectSurvey survey(const Document& document);

}  // namespace oriel
