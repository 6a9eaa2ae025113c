#include "io/cityjson/write/fresh_cityjson.h"

#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace oriel::detail {

namespace {

/// How far a coordinate may lie from a multiple of a millimetre to count as one: doubles in UTM are
/// good to a nanometre.
constexpr double kMultiple_m = 1e-8;  // tolerance of doubles
/// The scales of files.
constexpr double kMillimetre_m = 0.001;
constexpr double kMicrometre_m = 1e-6;  // a unit, no tolerance

double scale_of(const std::vector<Building>& buildings) {
  for (const Building& building : buildings)
    for (const Vec3 p : building.vertices)
      for (const double x : {p.x, p.y, p.z})
        if (std::abs(x - std::round(x / kMillimetre_m) * kMillimetre_m) > kMultiple_m)
          return kMicrometre_m;
  return kMillimetre_m;
}

Vec3 translation_of(const std::vector<Building>& buildings) {
  Box box;
  for (const Building& building : buildings) box.grow(building.frame.origin_m);
  return box.is_empty() ? Vec3{} : box.min;
}

/// "boundaries" with the vertex numbers moved up by `first`.
std::string boundaries_text(const Building& building, int first) {
  std::string text = building.is_solid ? "[[" : "[";
  for (const Polygon& polygon : building.polygons) {
    text += &polygon == &building.polygons.front() ? "[" : ",[";
    for (const auto& ring : polygon.rings) {
      std::vector<int> numbers = ring;
      for (int& number : numbers) number += first;
      if (&ring != &polygon.rings.front()) text += ',';
      append_json_array(text, numbers);
    }
    text += ']';
  }
  return text + (building.is_solid ? "]]" : "]");
}

void append_building(std::string& text, const Building& building, int first) {
  append_json_key(text, building.id);
  text += R"({"type":"Building","attributes":{},"geometry":[{"type":)";
  text += building.is_solid ? R"("Solid","lod":)" : R"("MultiSurface","lod":)";
  append_json(text, std::string_view(building.lod.empty() ? "3" : building.lod));
  text += R"(,"boundaries":)" + boundaries_text(building, first) + "}]}";
}

void append_vertices(std::string& text, const Building& building, const Transform& transform) {
  const Vec3 shift = building.frame.origin_m - transform.translate;
  for (const Vec3 p : building.vertices) {
    const Vec3 from = p + shift;
    if (text.back() != '[') text += ',';
    append_json_array(text, std::array<std::int64_t, 3>{std::llround(from.x / transform.scale.x),
                                                        std::llround(from.y / transform.scale.y),
                                                        std::llround(from.z / transform.scale.z)});
  }
}

}  // namespace

CityJsonSource fresh_cityjson(const std::vector<Building>& buildings) {
  CityJsonSource source;
  const double scale = scale_of(buildings);
  source.transform = {{scale, scale, scale}, translation_of(buildings)};
  const Vec3 t = source.transform.translate;
  std::string& text = source.text;
  text = R"({"type":"CityJSON","version":"2.0","transform":{"scale":)";
  append_json_array(text, std::array<double, 3>{scale, scale, scale});
  text += R"(,"translate":)";
  append_json_array(text, std::array<double, 3>{t.x, t.y, t.z});
  text += R"(},"CityObjects":{)";
  std::string vertices = "[";
  int first = 0;
  for (const Building& building : buildings) {
    source.places.push_back({source.places.size(), 0});
    append_building(text, building, first);
    append_vertices(vertices, building, source.transform);
    first += static_cast<int>(building.vertices.size());
  }
  text += R"(},"vertices":)" + vertices + "]}\n";
  return source;
}

}  // namespace oriel::detail
