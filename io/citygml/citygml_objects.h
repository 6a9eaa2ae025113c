#pragma once

#include "io/citygml/gml_geometry.h"
#include "io/citygml/xml_node.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// A boundary surface or an opening.
struct CityGmlSurface {
  /// CityJSON's name of it, such as "WallSurface" or "Window"; empty for one that has none there.
  std::string_view type;
  const XmlNode* node = nullptr;
  /// Of an opening, the surface it lies in; else -1.
  int parent = -1;
  /// Its polygons by level of detail ('0' … '4').
  std::map<char, std::vector<GmlPolygon>> polygons;
};

struct CityGmlGeometry {
  GmlGeometry geometry;
  char lod = '0';
  /// The surface of each polygon in reading order: an index into CityGmlObject::surfaces, or -1.
  std::vector<int> surface_of_polygon;
};

/// A building, a part of it, or what stands on it, without what is inside.
struct CityGmlObject {
  /// CityJSON's name: "Building", "BuildingPart", "BuildingInstallation" or
  /// "BuildingConstructiveElement".
  std::string_view type;
  std::string id;
  const XmlNode* node = nullptr;
  /// The object it belongs to; -1 for the building.
  int parent = -1;
  std::vector<int> children;
  std::vector<CityGmlSurface> surfaces;
  std::vector<CityGmlGeometry> geometries;
};

/// The objects of one building, itself first.
struct CityGmlBuilding {
  std::vector<CityGmlObject> objects;
  /// The first implicit geometry that was passed over, or null.
  const XmlNode* implicit = nullptr;
};

/// The building `member`, whose id is `id`. A fault anywhere in it costs the building: then
/// nothing, and `fault` says what (as GmlReader and XmlLinks do). Objects without gml:id are named
/// by their parent's, their type and a number.
///
/// Geometry at each level of detail: the solids as they are stated; all other surfaces, those of
/// the object and of its boundary surfaces and openings, as one MultiSurface, without the polygons
/// that a solid of the level has already. Polygons of a solid belong to the boundary surface that
/// shares them by a link, or has a polygon of the same vertices.
std::optional<CityGmlBuilding> read_objects(const XmlNode& member, const std::string& id,
                                            XmlLinks& links, GmlReader& reader,
                                            std::optional<NodeFault>& fault);

}  // namespace oriel::detail
