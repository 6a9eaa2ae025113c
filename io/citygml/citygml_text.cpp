#include "io/citygml/citygml_text.h"

#include "io/citygml/write/xml_text.h"
#include "io/json/words.h"
#include "kernel/base/index.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

enum class ValueKind { text, number, whole, numbers };

struct CityGmlAttribute {
  std::string name;
  /// As JSON.
  std::vector<std::string> values;
};

ValueKind kind_of(std::string_view name) {
  constexpr std::array<std::string_view, 4> kWhole{"storeysAboveGround", "storeysBelowGround",
                                                   "yearOfConstruction", "yearOfDemolition"};
  if (name == "measuredHeight") return ValueKind::number;
  if (name == "storeyHeightsAboveGround" || name == "storeyHeightsBelowGround")
    return ValueKind::numbers;
  return std::ranges::find(kWhole, name) != kWhole.end() ? ValueKind::whole : ValueKind::text;
}

/// "stringAttribute" of 2.0, "StringAttribute" of 3.0: the kind of its value.
std::optional<ValueKind> kind_of_generic(const XmlNode& node) {
  const std::string_view name = node.name;
  if (node.vocabulary != Vocabulary::generics || !name.ends_with("Attribute")) return std::nullopt;
  const auto starts = [&](std::string_view lower, std::string_view upper) {
    return name.starts_with(lower) || name.starts_with(upper);
  };
  if (starts("generic", "Generic")) return std::nullopt;
  if (starts("int", "Int")) return ValueKind::whole;
  if (starts("double", "Double") || starts("measure", "Measure")) return ValueKind::number;
  return ValueKind::text;
}

std::string json_of(std::string_view text, ValueKind kind) {
  std::string json;
  const auto number = as_double(text);
  const auto whole = as_whole(text);
  if (kind == ValueKind::whole && whole) {
    append_json(json, static_cast<std::int64_t>(*whole));
  } else if (kind == ValueKind::number && number && std::isfinite(*number)) {
    append_json(json, *number);
  } else if (kind == ValueKind::numbers) {
    json += '[';
    std::size_t at = text.find_first_not_of(" \t\r\n");
    while (at < text.size()) {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
      if (json.size() > 1) json += ',';
      json += json_of(text.substr(at, end - at), ValueKind::number);
      at = text.find_first_not_of(" \t\r\n", end);
    }
    json += ']';
  } else {
    append_json(json, text);
  }
  return json;
}

const XmlNode* child_named(const XmlNode& node, std::string_view name) {
  const auto found = std::ranges::find(node.children, name, &XmlNode::name);
  return found == node.children.end() ? nullptr : &*found;
}

class Attributes {
 public:
  void read(const XmlNode& object) {
    for (const XmlNode& child : object.children) read_property(child);
  }

  void append_to(std::string& out, const std::vector<std::string_view>& reserved) const {
    for (const CityGmlAttribute& attribute : attributes_) {
      const bool is_reserved = std::ranges::find(reserved, attribute.name) != reserved.end();
      std::string key(is_reserved ? "_" : "");
      append_json_key(out, key.append(attribute.name));
      if (attribute.values.size() == 1) {
        out += attribute.values[0];
        continue;
      }
      for (const std::string& value : attribute.values) {
        out += &value == &attribute.values.front() ? '[' : ',';
        out += value;
      }
      out += ']';
    }
  }

 private:
  void read_property(const XmlNode& property) {
    if (property.vocabulary == Vocabulary::other) return;
    if (read_generic(property)) return;
    if (property.name == "genericAttribute") {
      for (const XmlNode& value : property.children) read_generic(value);
    } else if (property.name == "height" && property.vocabulary == Vocabulary::construction) {
      read_height(property);
    } else if (const std::string_view text = trimmed(property.text);
               property.children.empty() && !text.empty()) {
      add(property.name, json_of(text, kind_of(property.name)));
    }
  }

  /// An attribute of the generics module: its name is an attribute in 2.0, an element in 3.0.
  bool read_generic(const XmlNode& node) {
    const bool is_set = node.name == "genericAttributeSet" || node.name == "GenericAttributeSet";
    const auto kind = kind_of_generic(node);
    if (node.vocabulary != Vocabulary::generics || (!kind && !is_set)) return false;
    const XmlNode* named = child_named(node, "name");
    const std::string name(named != nullptr ? trimmed(named->text) : node.attribute("name"));
    const XmlNode* value = child_named(node, "value");
    if (name == kObjectId) return true;
    if (is_set) {
      Attributes inner;
      for (const XmlNode& child : node.children)
        if (child.name != "name") inner.read_property(child);
      std::string json = "{";
      inner.append_to(json, {});
      json += '}';
      add(name, std::move(json));
    } else if (value != nullptr) {
      add(name, json_of(trimmed(value->text), *kind));
    }
    return true;
  }

  void read_height(const XmlNode& property) {
    const XmlNode* height = child_named(property, "Height");
    const XmlNode* value = height != nullptr ? child_named(*height, "value") : nullptr;
    if (value != nullptr && !number_of_.contains("measuredHeight"))
      add("measuredHeight", json_of(trimmed(value->text), ValueKind::number));
  }

  void add(const std::string& name, std::string value) {
    const auto [found, is_new] = number_of_.try_emplace(name, attributes_.size());
    if (is_new) attributes_.push_back({name, {}});
    attributes_[found->second].values.push_back(std::move(value));
  }

  std::vector<CityGmlAttribute> attributes_;
  std::unordered_map<std::string, std::size_t> number_of_;
};

}  // namespace

void append_attributes(std::string& out, const XmlNode& object,
                       const std::vector<std::string_view>& reserved) {
  Attributes attributes;
  attributes.read(object);
  attributes.append_to(out, reserved);
}

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
    // Ids that oriel has made say nothing.
    if (const std::string_view id = surface.node->id(); !id.empty() && !id.starts_with(kMadeId)) {
      append_json_key(out, "id");
      append_json(out, std::string_view(object_id(*surface.node)));
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
