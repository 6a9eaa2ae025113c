#pragma once

#include "io/cityjson/cityjson_source.h"
#include "io/objects/city_value.h"
#include "model/vec3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// A semantic surface of a geometry.
struct CitySurface {
  std::string type;
  /// The surface that it lies in, an index into CityGeometry::surfaces, or -1.
  int parent = -1;
  /// All other members but `children`.
  CityMembers members;
};

/// A polygon: its rings, the outer one first, as numbers of CityRecord::vertices.
struct CityPolygon {
  std::vector<std::vector<int>> rings;
  /// Index into CityGeometry::surfaces, or -1.
  int surface = -1;
};

/// A geometry of surfaces or solids; others are not read.
struct CityGeometry {
  /// "Solid", "MultiSurface" …
  std::string type;
  std::string lod;
  /// Bodies of shells of polygons; of surfaces one body with one shell.
  std::vector<std::vector<std::vector<CityPolygon>>> bodies;
  std::vector<CitySurface> surfaces;

  [[nodiscard]] bool is_solid() const { return type.ends_with("Solid"); }
};

struct CityObject {
  std::string id;
  std::string type;
  CityMembers attributes;
  /// Ids; what is not in the record is left out.
  std::vector<std::string> parents;
  std::vector<std::string> children;
  std::vector<CityGeometry> geometries;
};

/// What a CityJSON file, or a line of a CityJSONSeq, says of its objects: the model that other
/// formats are written from.
struct CityRecord {
  /// A line of a CityJSONSeq behind its header.
  bool is_feature = false;
  /// `metadata.referenceSystem` as it stands there, or empty.
  std::string crs;
  std::vector<CityObject> objects;
  /// In the input's coordinates, in metres.
  std::vector<Vec3> vertices;
};

/// The record that `text` is, which oriel has written or checked: what does not fit is left out. A
/// line of a CityJSONSeq has no transform of its own and takes `transform`.
CityRecord city_record(std::string_view text, const Transform& transform);

/// True if `one` has surfaces that oriel has named and `other` has none, or else the higher level
/// of detail.
bool says_more(const CityGeometry& one, const CityGeometry& other);
/// The geometry of an object that says most, of equals the first. Null without one.
const CityGeometry* leading_geometry(const CityObject& object);

/// Calls `visit(polygon)` with each polygon of a geometry in reading order.
template <class Geometry, class Visit>
void for_each_city_polygon(Geometry& geometry, const Visit& visit) {
  for (auto& shells : geometry.bodies)
    for (auto& shell : shells)
      for (auto& polygon : shell) visit(polygon);
}

}  // namespace oriel::detail
