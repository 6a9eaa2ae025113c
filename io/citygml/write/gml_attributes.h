#pragma once

#include "io/objects/city_value.h"

#include <string>
#include <string_view>

namespace oriel::detail {

/// Which CityGML is written.
enum class GmlVersion { two, three };

/// The attributes of an object in the order that the schema asks for: some stand before its
/// geometry, some behind the geometry of version 3.0. Those whose value is nothing are left out.
struct GmlAttributes {
  /// Description and names, of GML itself.
  std::string names;
  /// Dates, then all generic attributes: what has no element of its own, or does not fit it.
  std::string generic;
  /// Of the construction module (3.0): the height.
  std::string construction;
  /// Of the building module: class, function, usage and, of buildings, year, roof, height, storeys.
  std::string building;
};

/// What kind of object has them, which says what elements there are.
enum class GmlOwner { building, installation, surface };

/// `id`: the object's id if its gml:id had to be written otherwise, else empty; it becomes the
/// generic attribute kObjectId.
GmlAttributes gml_attributes(const CityMembers& members, GmlVersion version, GmlOwner owner,
                             std::string_view id = "");

}  // namespace oriel::detail
