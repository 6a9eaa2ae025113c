#include "io/cityjson/material_colours.h"

#include "io/cityjson/cityjson_geometry.h"
#include "io/cityjson/cityjson_source.h"
#include "io/json/dom.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace oriel {

namespace {

namespace dom = detail::dom;
using detail::as_array;
using detail::as_integer;
using detail::as_number;
using detail::as_object;
using detail::as_string;
using detail::member;
std::uint8_t as_byte(double share) {
  constexpr double kMost = 255;
  return static_cast<std::uint8_t>(std::lround(kMost * std::clamp(share, 0.0, 1.0)));
}

std::optional<FaceColour> colour_of_material(dom::object material) {
  const auto diffuse = as_array(member(material, "diffuseColor"));
  if (!diffuse || diffuse->size() != 3) return std::nullopt;
  FaceColour colour{};
  std::size_t i = 0;
  for (const dom::element share : *diffuse) {
    const auto number = as_number(share);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    colour.at(i++) = as_byte(*number);
  }
  colour[3] = as_byte(1 - as_number(member(material, "transparency")).value_or(0));
  return colour;
}

/// The element of an array, or nothing.
std::optional<dom::element> element_at(const std::optional<dom::array>& array, std::size_t number) {
  dom::element element;
  if (!array || array->at(number).get(element) != simdjson::SUCCESS) return std::nullopt;
  return element;
}

/// Reads the materials of one record.
class MaterialReader {
 public:
  explicit MaterialReader(dom::object root) {
    const auto appearance = as_object(member(root, "appearance"));
    if (!appearance) return;
    theme_ = as_string(member(*appearance, "default-theme-material"));
    const auto materials = as_array(member(*appearance, "materials"));
    if (!materials) return;
    for (const dom::element material : *materials) {
      const auto object = as_object(material);
      materials_.push_back(object ? colour_of_material(*object) : std::nullopt);
    }
  }

  [[nodiscard]] bool has_colours() const {
    return std::ranges::any_of(materials_, [](const auto& one) { return one.has_value(); });
  }

  /// Appends those of the polygons of a geometry.
  void append(dom::object geometry, FaceColours& colours) const {
    const auto kind =
        detail::kind_of_geometry(as_string(member(geometry, "type")).value_or(std::string_view()));
    const auto boundaries = as_array(member(geometry, "boundaries"));
    if (!kind || !boundaries) return;
    const auto theme = theme_of(geometry);
    const auto one = theme ? as_integer(member(*theme, "value")) : std::nullopt;
    const auto values = theme ? member(*theme, "values") : std::nullopt;
    append(*boundaries, kind->depth, values, one, colours);
  }

 private:
  [[nodiscard]] std::optional<dom::object> theme_of(dom::object geometry) const {
    const auto themes = as_object(member(geometry, "material"));
    if (!themes) return std::nullopt;
    if (theme_)
      if (auto asked = as_object(member(*themes, *theme_))) return asked;
    for (const auto& [name, theme] : *themes) return as_object(theme);
    return std::nullopt;
  }

  /// `values` repeats the shape of `boundaries`, without rings; `one` holds for all.
  void append(dom::array boundaries, int depth, const std::optional<dom::element>& values,
              const std::optional<std::int64_t>& one, FaceColours& colours) const {
    std::vector<dom::element> of_parts;
    if (const auto list = as_array(values))
      for (const dom::element value : *list) of_parts.push_back(value);
    std::size_t i = 0;
    for (const dom::element part : boundaries) {
      std::optional<dom::element> value;
      if (i < of_parts.size()) value = of_parts[i];
      ++i;
      const auto parts = as_array(part);
      if (depth > 0 && parts)
        append(*parts, depth - 1, value, one, colours);
      else if (depth == 0)
        colours.push_back(colour(one ? one : as_integer(value)));
    }
  }

  [[nodiscard]] std::optional<FaceColour> colour(const std::optional<std::int64_t>& number) const {
    if (!number || *number < 0 || static_cast<std::size_t>(*number) >= materials_.size())
      return std::nullopt;
    return materials_[static_cast<std::size_t>(*number)];
  }

  std::optional<std::string_view> theme_;
  FaceColours materials_;
};

/// The geometries of all CityObjects, each found once by walking over them.
class GeometryFinder {
 public:
  explicit GeometryFinder(dom::object root) {
    if (const auto objects = as_object(member(root, "CityObjects")))
      for (const auto& [id, object] : *objects) objects_.push_back(as_object(object));
  }

  [[nodiscard]] std::optional<dom::object> at(const GeometryPlace& place) const {
    if (place.object >= objects_.size() || !objects_[place.object]) return std::nullopt;
    return as_object(
        element_at(as_array(member(*objects_[place.object], "geometry")), place.geometry));
  }

 private:
  std::vector<std::optional<dom::object>> objects_;
};

}  // namespace

std::vector<FaceColours> material_colours(const Document& document) {
  std::vector<FaceColours> all(document.buildings.size());
  if (!document.source || document.source->text.find("\"materials\"") == std::string::npos)
    return all;
  const CityJsonSource& source = *document.source;
  dom::parser parser;
  dom::object root;
  if (parser.parse(source.text).get(root) != simdjson::SUCCESS) return all;
  const MaterialReader materials(root);
  if (!materials.has_colours()) return all;
  const GeometryFinder geometries(root);
  for (std::size_t b = 0; b < std::min(all.size(), source.places.size()); ++b) {
    std::vector<GeometryPlace> places{source.places[b]};
    if (b < source.joined.size())
      places.insert(places.end(), source.joined[b].begin(), source.joined[b].end());
    for (const GeometryPlace& place : places)
      if (const auto geometry = geometries.at(place)) materials.append(*geometry, all[b]);
  }
  return all;
}

}  // namespace oriel
