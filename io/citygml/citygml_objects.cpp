#include "io/citygml/citygml_objects.h"

#include "model/labelled_building.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// CityGML's name and CityJSON's.
struct TypeName {
  std::string_view gml;
  std::string_view json;
};

/// Boundary surfaces and openings of the outside. What is not here is inside, or an extension.
constexpr std::array<TypeName, 10> kSurfaceTypes{{{"WallSurface", "WallSurface"},
                                                  {"RoofSurface", "RoofSurface"},
                                                  {"GroundSurface", "GroundSurface"},
                                                  {"ClosureSurface", "ClosureSurface"},
                                                  {"OuterCeilingSurface", "OuterCeilingSurface"},
                                                  {"OuterFloorSurface", "OuterFloorSurface"},
                                                  {"Window", "Window"},
                                                  {"Door", "Door"},
                                                  {"WindowSurface", "Window"},
                                                  {"DoorSurface", "Door"}}};

constexpr std::array<std::string_view, 3> kInside{"InteriorWallSurface", "CeilingSurface",
                                                  "FloorSurface"};

/// Properties that hold objects of the outside: 2.0 and 3.0.
constexpr std::array<TypeName, 5> kObjectProperties{{
    {"consistsOfBuildingPart", "BuildingPart"},
    {"buildingPart", "BuildingPart"},
    {"outerBuildingInstallation", "BuildingInstallation"},
    {"buildingInstallation", "BuildingInstallation"},
    {"buildingConstructiveElement", "BuildingConstructiveElement"},
}};

template <std::size_t n>
std::string_view json_name(const std::array<TypeName, n>& names, std::string_view gml) {
  const auto* const found = std::ranges::find(names, gml, &TypeName::gml);
  return found == names.end() ? std::string_view() : found->json;
}

/// A property such as lod2MultiSurface: its level and what follows that; level 0 if it is none.
struct LodProperty {
  char lod = 0;
  std::string_view kind;
};

LodProperty lod_property(const XmlNode& node) {
  const std::string_view name = node.name;
  if (!is_city(node) || name.size() < 5 || !name.starts_with("lod") || name[3] < '0' ||
      name[3] > '4')
    return {};
  return {name[3], name.substr(4)};
}

/// True for what CityGML 3.0 says to be inside.
bool is_said_inside(const XmlNode& node) {
  return std::ranges::any_of(node.children, [](const XmlNode& child) {
    return child.name == "relationToConstruction" && trimmed(child.text) == "inside";
  });
}

template <class Visit>
void for_each_polygon(const GmlGeometry& geometry, const Visit& visit) {
  for (const auto& shells : geometry.bodies)
    for (const auto& shell : shells)
      for (const GmlPolygon& polygon : shell) visit(polygon);
}

/// What polygons have in common that lie in the same place, whichever way round.
std::vector<int> corners_of(const GmlPolygon& polygon) {
  std::vector<int> corners = polygon.rings[0];
  std::ranges::sort(corners);
  return corners;
}

class ObjectReader {
 public:
  ObjectReader(XmlLinks& links, GmlReader& reader) : links_(links), reader_(reader) {}

  bool read(const XmlNode& node, std::string_view type, std::string id, int parent);
  [[nodiscard]] const std::optional<NodeFault>& fault() const { return fault_; }
  CityGmlBuilding take() { return std::move(building_); }

 private:
  bool read_surfaces(const XmlNode& node, std::string_view own_type, int parent,
                     CityGmlObject& object);
  bool read_surfaces_in(const XmlNode& property, std::string_view own_type, int parent,
                        CityGmlObject& object);
  bool read_surface(const XmlNode& node, int parent, CityGmlObject& object);
  bool read_stated(CityGmlObject& object);
  static void collect(char lod, CityGmlObject& object);
  bool read_children(std::size_t index);
  /// Passes on the fault of whom it asked.
  bool has_failed();

  /// Calls `visit` with each value of `property`; false for a fault.
  template <class Visit>
  bool for_each_value(const XmlNode& property, const Visit& visit) {
    ++depth_;
    for (const XmlNode* value : links_.values_of(property)) {
      if (++visited_ > XmlLinks::kVisits * links_.node_count())
        fault_ = XmlLinks::too_many(property);
      else if (depth_ > XmlLinks::kMaxDepth)
        fault_ = XmlLinks::too_deep(property);
      if (fault_ || !visit(*value)) return false;
    }
    --depth_;
    return !has_failed();
  }

  XmlLinks& links_;
  GmlReader& reader_;
  CityGmlBuilding building_;
  /// The surfaces of this object and all objects met so far: each is read once.
  std::set<const XmlNode*> met_surfaces_;
  std::set<const XmlNode*> met_objects_;
  /// How many properties reading stands in.
  int depth_ = 0;
  std::size_t visited_ = 0;
  std::optional<NodeFault> fault_;
};

bool ObjectReader::has_failed() {
  if (!fault_) fault_ = reader_.fault() ? reader_.fault() : links_.fault();
  return fault_.has_value();
}

bool ObjectReader::read(const XmlNode& node, std::string_view type, std::string id, int parent) {
  if (!met_objects_.insert(&node).second) return true;
  met_surfaces_.clear();
  CityGmlObject object;
  object.type = type;
  object.id = std::move(id);
  object.node = &node;
  object.parent = parent;
  if (!read_surfaces(node, "", -1, object) || !read_stated(object)) return false;
  for (const char lod : {'0', '1', '2', '3', '4'}) collect(lod, object);
  const auto index = static_cast<int>(building_.objects.size());
  if (parent >= 0) building_.objects[static_cast<std::size_t>(parent)].children.push_back(index);
  building_.objects.push_back(std::move(object));
  return read_children(building_.objects.size() - 1);
}

/// Reads the boundary surfaces and fillings of `node`, also those that stand in the property of a
/// geometry instead of beside it.
bool ObjectReader::read_surfaces(const XmlNode& node, std::string_view own_type, int parent,
                                 CityGmlObject& object) {
  for (const XmlNode& property : node.children) {
    if (!read_surfaces_in(property, own_type, parent, object)) return false;
    if (lod_property(property).lod == 0) continue;
    for (const XmlNode& inner : property.children)
      if (!read_surfaces_in(inner, own_type, parent, object)) return false;
  }
  return true;
}

bool ObjectReader::read_surfaces_in(const XmlNode& property, std::string_view own_type, int parent,
                                    CityGmlObject& object) {
  if (!holds_boundary(property)) return true;
  return for_each_value(property, [&](const XmlNode& value) {
    // The faces of a Window or Door that is a thing of its own are all its surface.
    const bool is_plain = own_type.empty() || !json_name(kSurfaceTypes, value.name).empty();
    return !is_plain || read_surface(value, parent, object);
  });
}

bool ObjectReader::read_surface(const XmlNode& node, int parent, CityGmlObject& object) {
  if (std::ranges::find(kInside, node.name) != kInside.end()) return true;
  if (!met_surfaces_.insert(&node).second) return true;
  const auto index = static_cast<int>(object.surfaces.size());
  CityGmlSurface surface{json_name(kSurfaceTypes, node.name), &node, parent, {}};
  for (const XmlNode& property : node.children) {
    const auto [lod, kind] = lod_property(property);
    if (lod == 0) continue;
    if (kind == "ImplicitRepresentation" && building_.implicit == nullptr)
      building_.implicit = &property;
    if (kind != "MultiSurface" && kind != "Solid" && kind != "Geometry") continue;
    std::vector<GmlPolygon> polygons = reader_.read_polygons(property);
    if (has_failed()) return false;
    std::ranges::move(polygons, std::back_inserter(surface.polygons[lod]));
  }
  const std::string_view type = surface.type;
  object.surfaces.push_back(std::move(surface));
  return read_surfaces(node, is_opening_type(type) ? type : "", index, object);
}

/// Reads the geometries that the object itself states.
bool ObjectReader::read_stated(CityGmlObject& object) {
  for (const XmlNode& property : object.node->children) {
    const auto [lod, kind] = lod_property(property);
    if (lod == 0) continue;
    if (kind == "ImplicitRepresentation" && building_.implicit == nullptr)
      building_.implicit = &property;
    constexpr std::array<std::string_view, 5> kRead{"Solid", "MultiSurface", "Geometry",
                                                    "FootPrint", "RoofEdge"};
    if (std::ranges::find(kRead, kind) == kRead.end()) continue;
    std::vector<GmlGeometry> geometries = reader_.read(property);
    if (has_failed()) return false;
    for (GmlGeometry& geometry : geometries)
      object.geometries.push_back({std::move(geometry), lod, {}});
  }
  return true;
}

/// Tells the polygons of the level which surface they belong to, and makes one MultiSurface of all
/// that no solid has.
void ObjectReader::collect(char lod, CityGmlObject& object) {
  std::unordered_map<const XmlNode*, int> surface_of_node;
  std::map<std::vector<int>, int> surface_at;
  std::set<std::vector<int>> stated;
  for (std::size_t s = 0; s < object.surfaces.size(); ++s) {
    const auto found = object.surfaces[s].polygons.find(lod);
    if (found == object.surfaces[s].polygons.end()) continue;
    for (const GmlPolygon& polygon : found->second) {
      surface_of_node.try_emplace(polygon.node, static_cast<int>(s));
      surface_at.try_emplace(corners_of(polygon), static_cast<int>(s));
    }
  }
  CityGmlGeometry* surfaces = nullptr;
  for (CityGmlGeometry& one : object.geometries) {
    if (one.lod != lod) continue;
    if (one.geometry.type == "MultiSurface" && surfaces == nullptr) surfaces = &one;
    for_each_polygon(one.geometry, [&](const GmlPolygon& polygon) {
      std::vector<int> corners = corners_of(polygon);
      const auto by_node = surface_of_node.find(polygon.node);
      const auto by_place = surface_at.find(corners);
      const bool is_linked = by_node != surface_of_node.end();
      one.surface_of_polygon.push_back(is_linked                      ? by_node->second
                                       : by_place != surface_at.end() ? by_place->second
                                                                      : -1);
      stated.insert(std::move(corners));
    });
  }
  CityGmlGeometry rest{{"MultiSurface", {{{}}}}, lod, {}};
  CityGmlGeometry& all = surfaces != nullptr ? *surfaces : rest;
  for (std::size_t s = 0; s < object.surfaces.size(); ++s) {
    const auto found = object.surfaces[s].polygons.find(lod);
    if (found == object.surfaces[s].polygons.end()) continue;
    for (const GmlPolygon& polygon : found->second) {
      if (stated.contains(corners_of(polygon))) continue;
      all.geometry.bodies[0][0].push_back(polygon);
      all.surface_of_polygon.push_back(static_cast<int>(s));
    }
  }
  if (surfaces == nullptr && !rest.surface_of_polygon.empty())
    object.geometries.push_back(std::move(rest));
}

bool ObjectReader::read_children(std::size_t index) {
  const XmlNode& node = *building_.objects[index].node;
  const std::string id = building_.objects[index].id;
  std::map<std::string_view, int> count;
  for (const XmlNode& property : node.children) {
    const std::string_view type =
        is_city(property) ? json_name(kObjectProperties, property.name) : std::string_view();
    if (type.empty()) continue;
    const bool is_good = for_each_value(property, [&](const XmlNode& value) {
      if (is_said_inside(value)) return true;
      const std::string name = fmt::format("{}_{}_{}", id, type, ++count[type]);
      return read(value, type, value.id().empty() ? name : object_id(value),
                  static_cast<int>(index));
    });
    if (!is_good) return false;
  }
  return true;
}

}  // namespace

std::optional<CityGmlBuilding> read_objects(const XmlNode& member, const std::string& id,
                                            XmlLinks& links, GmlReader& reader,
                                            std::optional<NodeFault>& fault) {
  ObjectReader objects(links, reader);
  if (objects.read(member, "Building", id, -1)) return objects.take();
  fault = objects.fault();
  return std::nullopt;
}

}  // namespace oriel::detail
