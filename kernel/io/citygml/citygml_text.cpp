#include "kernel/io/citygml/citygml_text.h"

#include "kernel/base/index.h"
#include "kernel/io/citygml/citygml_attributes.h"
#include "kernel/io/json/json_text.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace oriel::detail {

namespace {

/// `[a,b,…]` with each element as `append` writes it.
template <class Items, class Append>
void append_array(std::string& out, const Items& items, const Append& append) {
  out += '[';
  const char* separator = "";
  for (const auto& item : items) {
    out += separator;
    append(item);
    separator = ",";
  }
  out += ']';
}

/// The value of `append(polygon)` for all polygons, nested as the geometry is.
template <class Append>
void append_nested(std::string& out, const GmlGeometry& geometry, const Append& append) {
  const auto append_shell = [&](const auto& shell) { append_array(out, shell, append); };
  const auto append_body = [&](const auto& body) { append_array(out, body, append_shell); };
  if (geometry.type == "MultiSurface")
    append_shell(geometry.bodies[0][0]);
  else if (geometry.type == "Solid")
    append_body(geometry.bodies[0]);
  else
    append_array(out, geometry.bodies, append_body);
}

/// The semantic surfaces of one geometry: those that its polygons have.
class Semantics {
 public:
  Semantics(const CityGmlObject& object, const CityGmlGeometry& geometry)
      : object_(object), geometry_(geometry) {
    for (const int surface : geometry.surface_of_polygon)
      if (surface >= 0 && !object.surfaces[at(surface)].type.empty()) number_of_[surface] = 0;
    int next = 0;
    for (auto& [surface, number] : number_of_) number = next++;
    for (const auto& [surface, number] : number_of_)
      if (const auto parent = number_of_.find(object.surfaces[at(surface)].parent);
          parent != number_of_.end())
        children_of_[parent->first].push_back(number);
  }

  void append_to(std::string& out) const {
    if (number_of_.empty()) return;
    out += R"(,"semantics":{"surfaces":)";
    append_array(out, number_of_, [&](const auto& entry) { append_surface(out, entry.first); });
    out += R"(,"values":)";
    std::size_t next = 0;
    append_nested(out, geometry_.geometry, [&](const GmlPolygon&) {
      const auto number = number_of_.find(geometry_.surface_of_polygon[next++]);
      if (number == number_of_.end())
        out += "null";
      else
        append_json(out, number->second);
    });
    out += '}';
  }

 private:
  void append_surface(std::string& out, int index) const {
    const CityGmlSurface& surface = object_.surfaces[at(index)];
    out += '{';
    append_json_key(out, "type");
    append_json(out, surface.type);
    if (const std::string_view id = surface.node->id(); !id.empty()) {
      append_json_key(out, "id");
      append_json(out, id);
    }
    if (const auto parent = number_of_.find(surface.parent); parent != number_of_.end()) {
      append_json_key(out, "parent");
      append_json(out, parent->second);
    }
    if (const auto children = children_of_.find(index); children != children_of_.end()) {
      append_json_key(out, "children");
      append_json_array(out, children->second);
    }
    append_attributes(out, *surface.node, {"type", "id", "parent", "children"});
    out += '}';
  }

  const CityGmlObject& object_;
  const CityGmlGeometry& geometry_;
  /// The number of each surface that is written, by its index in the object.
  std::map<int, int> number_of_;
  std::map<int, std::vector<int>> children_of_;
};

void append_geometry(std::string& out, const CityGmlObject& object,
                     const CityGmlGeometry& geometry) {
  out += '{';
  append_json_key(out, "type");
  append_json(out, geometry.geometry.type);
  append_json_key(out, "lod");
  append_json(out, std::string_view(&geometry.lod, 1));
  append_json_key(out, "boundaries");
  append_nested(out, geometry.geometry, [&](const GmlPolygon& polygon) {
    append_array(out, polygon.rings,
                 [&](const std::vector<int>& ring) { append_json_array(out, ring); });
  });
  Semantics(object, geometry).append_to(out);
  out += '}';
}

void append_object(std::string& out, const CityGmlBuilding& building, std::size_t index) {
  const CityGmlObject& object = building.objects[index];
  append_json_key(out, object.id);
  out += R"({"type":)";
  append_json(out, object.type);
  out += R"(,"attributes":{)";
  append_attributes(out, *object.node);
  out += '}';
  std::vector<std::string_view> children;
  for (const int child : object.children) children.push_back(building.objects[at(child)].id);
  if (!children.empty()) {
    append_json_key(out, "children");
    append_json_array(out, children);
  }
  if (object.parent >= 0) {
    append_json_key(out, "parents");
    append_json_array(out, std::array<std::string_view, 1>{building.objects[at(object.parent)].id});
  }
  append_json_key(out, "geometry");
  append_array(out, object.geometries,
               [&](const CityGmlGeometry& geometry) { append_geometry(out, object, geometry); });
  out += '}';
}

}  // namespace

std::string citygml_header_text(const SequenceHeader& header) {
  const Vec3 scale = header.transform.scale;
  const Vec3 origin = header.transform.translate;
  std::string text = R"({"type":"CityJSON","version":"2.0","transform":{"scale":)";
  append_json_array(text, std::array{scale.x, scale.y, scale.z});
  text += R"(,"translate":)";
  append_json_array(text, std::array{origin.x, origin.y, origin.z});
  text += '}';
  if (!header.crs.empty()) {
    text += R"(,"metadata":{"referenceSystem":)";
    append_json(text, std::string_view(header.crs));
    text += '}';
  }
  return text + R"(,"CityObjects":{},"vertices":[]})";
}

std::string citygml_feature_text(const CityGmlBuilding& building, const GmlVertices& vertices) {
  std::string text = R"({"type":"CityJSONFeature","id":)";
  append_json(text, std::string_view(building.objects.front().id));
  text += R"(,"CityObjects":{)";
  for (std::size_t i = 0; i < building.objects.size(); ++i) append_object(text, building, i);
  text += R"(},"vertices":)";
  append_array(text, vertices.positions(),
               [&](const GmlVertices::Position& position) { append_json_array(text, position); });
  return text + "}";
}

std::string reference_system_of(std::string_view srs_name) {
  std::string_view code = srs_name.substr(srs_name.find_last_of(":/") + 1);
  const bool is_number =
      !code.empty() && code.find_first_not_of("0123456789") == std::string_view::npos;
  const bool is_compound = srs_name.find(',') != std::string_view::npos;
  const bool is_epsg = srs_name.starts_with("EPSG:") ||
                       srs_name.starts_with("urn:ogc:def:crs:EPSG:") ||
                       srs_name.starts_with("http://www.opengis.net/def/crs/EPSG/") ||
                       srs_name.starts_with("https://www.opengis.net/def/crs/EPSG/");
  if (!is_number || !is_epsg || is_compound) return std::string(srs_name);
  return "https://www.opengis.net/def/crs/EPSG/0/" + std::string(code);
}

}  // namespace oriel::detail
