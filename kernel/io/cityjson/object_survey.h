#pragma once

#include "kernel/io/document.h"
#include "kernel/io/unread_object.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace oriel {

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

/// Looks through the text of a document. Of CityGML a record is one family and has no list of
/// levels, and what stands in no building has no record (Reader::take_unread()); of meshes each
/// building is its own family.
ObjectSurvey survey(const Document& document);

}  // namespace oriel
