#include "io/objects/city_record.h"

#include "io/cityjson/cityjson_geometry.h"
#include "io/json/dom.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace oriel::detail {

namespace {

CityValue city_value(dom::element element);

CityMembers city_members(dom::object object) {
  CityMembers members;
  for (const auto& [key, value] : object) members.emplace_back(std::string(key), city_value(value));
  return members;
}

CityList city_list(dom::array array) {
  CityList list;
  for (const dom::element value : array) list.push_back(city_value(value));
  return list;
}

CityValue city_value(dom::element element) {
  switch (element.type()) {
    case dom::element_type::BOOL:
      return {bool(element)};
    case dom::element_type::INT64:
      return {std::int64_t(element)};
    case dom::element_type::UINT64:
    case dom::element_type::DOUBLE:
      return {as_number(element).value_or(0)};
    case dom::element_type::STRING:
      return {std::string(std::string_view(element))};
    case dom::element_type::ARRAY:
      return {city_list(element)};
    case dom::element_type::OBJECT:
      return {city_members(element)};
    default:
      return {};
  }
}

std::vector<std::string> ids_of(const std::optional<dom::element>& element) {
  std::vector<std::string> ids;
  if (const auto array = as_array(element))
    for (const dom::element id : *array)
      if (const auto text = as_string(id)) ids.emplace_back(*text);
  return ids;
}

std::optional<Vec3> city_vector(const std::optional<dom::element>& element) {
  const auto array = as_array(element);
  if (!array || array->size() != 3) return std::nullopt;
  std::array<double, 3> numbers{};
  std::size_t i = 0;
  for (const dom::element number : *array) numbers[i++] = as_number(number).value_or(0);
  return Vec3{numbers[0], numbers[1], numbers[2]};
}

/// Scale and translation leave noise in the last digits: the number of whole micrometres that was
/// meant, where there is one.
double decimal(double coordinate) {
  constexpr double kPerMetre = 1e6, kNoise_m = 2e-9;
  const double whole = std::round(coordinate * kPerMetre) / kPerMetre;
  return std::abs(whole - coordinate) <= kNoise_m ? whole : coordinate;
}

class CityRecordReader {
 public:
  CityRecord read(std::string_view text, const Transform& transform) {
    dom::object root;
    if (parser_.parse(text.data(), text.size()).get(root) != simdjson::SUCCESS) return {};
    transform_ = transform;
    if (const auto own = as_object(member(root, "transform"))) {
      transform_.scale = city_vector(member(*own, "scale")).value_or(transform_.scale);
      transform_.translate = city_vector(member(*own, "translate")).value_or(transform_.translate);
    }
    record_.is_feature = as_string(member(root, "type")) == "CityJSONFeature";
    read_vertices(root);
    if (const auto metadata = as_object(member(root, "metadata")))
      record_.crs = as_string(member(*metadata, "referenceSystem")).value_or("");
    if (const auto objects = as_object(member(root, "CityObjects")))
      for (const auto& [key, value] : *objects)
        if (const auto object = as_object(value)) read_object(std::string(key), *object);
    drop_strangers();
    return std::move(record_);
  }

 private:
  void read_vertices(dom::object root) {
    const auto vertices = as_array(member(root, "vertices"));
    if (!vertices) return;
    const auto [scale, translate] = transform_;
    for (const dom::element vertex : *vertices) {
      const Vec3 n = city_vector(vertex).value_or(Vec3{});
      record_.vertices.push_back({decimal(translate.x + scale.x * n.x),
                                  decimal(translate.y + scale.y * n.y),
                                  decimal(translate.z + scale.z * n.z)});
    }
  }

  void read_object(std::string id, dom::object object) {
    CityObject& read = record_.objects.emplace_back();
    read.id = std::move(id);
    read.type = as_string(member(object, "type")).value_or("");
    if (const auto attributes = as_object(member(object, "attributes")))
      read.attributes = city_members(*attributes);
    read.parents = ids_of(member(object, "parents"));
    read.children = ids_of(member(object, "children"));
    if (const auto geometries = as_array(member(object, "geometry")))
      for (const dom::element geometry : *geometries)
        if (const auto known = as_object(geometry)) read_geometry(*known, read);
  }

  void read_geometry(dom::object geometry, CityObject& object) {
    CityGeometry read;
    read.type = as_string(member(geometry, "type")).value_or("");
    const auto kind = kind_of_geometry(read.type);
    const auto boundaries = as_array(member(geometry, "boundaries"));
    if (!kind || !boundaries) return;
    if (const auto lod = as_string(member(geometry, "lod")))
      read.lod = *lod;
    else if (const auto number = as_number(member(geometry, "lod")))
      read.lod = std::to_string(static_cast<int>(*number));
    read_bodies(*boundaries, kind->depth, read);
    if (const auto semantics = as_object(member(geometry, "semantics")))
      read_semantics(*semantics, kind->depth, read);
    object.geometries.push_back(std::move(read));
  }

  void read_bodies(dom::array boundaries, int depth, CityGeometry& geometry) {
    if (depth < 2) return read_shells(boundaries, depth, geometry);
    for (const dom::element body : boundaries)
      if (const auto shells = as_array(body)) read_shells(*shells, depth, geometry);
  }

  void read_shells(dom::array body, int depth, CityGeometry& geometry) {
    auto& shells = geometry.bodies.emplace_back();
    if (depth == 0) return read_polygons(body, shells.emplace_back());
    for (const dom::element shell : body)
      if (const auto polygons = as_array(shell)) read_polygons(*polygons, shells.emplace_back());
  }

  void read_polygons(dom::array shell, std::vector<CityPolygon>& polygons) const {
    for (const dom::element polygon : shell) {
      CityPolygon& read = polygons.emplace_back();
      const auto rings = as_array(polygon);
      if (!rings) continue;
      for (const dom::element ring : *rings) {
        if (const auto numbers = as_array(ring)) read_ring(*numbers, read);
        if (read.rings.empty()) break;  // holes of nothing
      }
    }
  }

  void read_ring(dom::array numbers, CityPolygon& polygon) const {
    std::vector<int> ring;
    const auto count = static_cast<std::int64_t>(record_.vertices.size());
    for (const dom::element number : numbers) {
      const auto vertex = as_integer(number);
      if (!vertex || *vertex < 0 || *vertex >= count) continue;
      if (ring.empty() || ring.back() != *vertex) ring.push_back(static_cast<int>(*vertex));
    }
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    if (ring.size() >= 3) polygon.rings.push_back(std::move(ring));
  }

  static void read_semantics(dom::object semantics, int depth, CityGeometry& geometry) {
    const auto surfaces = as_array(member(semantics, "surfaces"));
    if (!surfaces) return;
    for (const dom::element surface : *surfaces) {
      CitySurface& read = geometry.surfaces.emplace_back();
      const auto object = as_object(surface);
      if (!object) continue;
      read.type = as_string(member(*object, "type")).value_or("");
      if (const auto parent = as_integer(member(*object, "parent")))
        read.parent = static_cast<int>(*parent);
      for (const auto& [key, value] : *object)
        if (key != "type" && key != "parent" && key != "children")
          read.members.emplace_back(std::string(key), city_value(value));
    }
    const auto count = static_cast<int>(geometry.surfaces.size());
    for (int s = 0; s < count; ++s)
      if (int& parent = geometry.surfaces[at(s)].parent; parent >= count || parent == s)
        parent = -1;
    if (const auto values = as_array(member(semantics, "values")))
      set_surfaces(*values, depth, geometry);
  }

  static void set_surfaces(dom::array values, int depth, CityGeometry& geometry) {
    std::size_t b = 0;
    if (depth < 2) return set_surfaces_of_body(values, depth, geometry, 0);
    for (const dom::element body : values) {
      if (const auto shells = as_array(body)) set_surfaces_of_body(*shells, depth, geometry, b);
      ++b;
    }
  }

  static void set_surfaces_of_body(dom::array body, int depth, CityGeometry& geometry,
                                   std::size_t b) {
    if (b >= geometry.bodies.size()) return;
    auto& shells = geometry.bodies[b];
    const auto set = [&](dom::array numbers, std::vector<CityPolygon>& polygons) {
      std::size_t p = 0;
      for (const dom::element number : numbers) {
        if (p >= polygons.size()) return;
        const auto surface = as_integer(number);
        const auto count = static_cast<std::int64_t>(geometry.surfaces.size());
        if (surface && *surface >= 0 && *surface < count)
          polygons[p].surface = static_cast<int>(*surface);
        ++p;
      }
    };
    if (depth == 0) return set(body, shells[0]);
    std::size_t s = 0;
    for (const dom::element shell : body) {
      if (s >= shells.size()) return;
      if (const auto numbers = as_array(shell)) set(*numbers, shells[s]);
      ++s;
    }
  }

  /// Links that lead out of the record, and polygons that have no ring left.
  void drop_strangers() {
    std::unordered_set<std::string_view> ids;
    for (const CityObject& object : record_.objects) ids.insert(object.id);
    const auto is_stranger = [&](const std::string& id) { return !ids.contains(id); };
    for (CityObject& object : record_.objects) {
      std::erase_if(object.parents, is_stranger);
      std::erase_if(object.children, is_stranger);
      for (CityGeometry& geometry : object.geometries)
        for (auto& shells : geometry.bodies)
          for (auto& shell : shells)
            std::erase_if(shell, [](const CityPolygon& one) { return one.rings.empty(); });
    }
  }

  dom::parser parser_;
  Transform transform_;
  CityRecord record_;
};

bool has_own_surfaces(const CityGeometry& geometry) {
  return std::ranges::any_of(geometry.surfaces, [](const CitySurface& surface) {
    return std::ranges::any_of(surface.members,
                               [](const auto& one) { return one.first.starts_with("oriel_"); });
  });
}

}  // namespace

CityRecord city_record(std::string_view text, const Transform& transform) {
  return CityRecordReader().read(text, transform);
}

bool says_more(const CityGeometry& one, const CityGeometry& other) {
  const auto rank = [](const CityGeometry& of) {
    return std::pair(has_own_surfaces(of), std::string_view(of.lod));
  };
  return rank(one) > rank(other);
}

const CityGeometry* leading_geometry(const CityObject& object) {
  const CityGeometry* best = nullptr;
  for (const CityGeometry& geometry : object.geometries)
    if (best == nullptr || says_more(geometry, *best)) best = &geometry;
  return best;
}

}  // namespace oriel::detail
