#pragma once

#include "io/cityjson/write/semantics_text.h"
#include "model/solid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// The text of a geometry's polygons, and how they are nested.
struct GeometryText {
  GeometryShape shape;
  /// The text of each polygon, an array of rings: slices of the boundaries.
  std::vector<std::string_view> polygons;
};

/// The polygons in "boundaries" of a geometry that is nested `depth` deep, numbered in reading
/// order; their texts only if `with_polygons`.
GeometryText geometry_of(std::string_view boundaries, int depth, bool with_polygons);

/// A solid as it is written.
struct SolidText {
  std::string_view type;
  std::string boundaries;
  GeometryShape shape;
  /// The text of each facet, empty for one that vanished because its vertices became one.
  std::vector<std::string> facets;
  /// The facet of each polygon written, in order.
  std::vector<int> order;
};

/// The boundaries of `solid`: a Solid for one lump, else a MultiSolid; each lump's outer shell
/// first, its cavities behind it. `number_of` gives the file's vertex for each of the solid's.
SolidText solid_text(const Solid& solid, std::span<const int> number_of);

/// Calls `visit` with each array of vertex numbers under the key "boundaries", at any depth of the
/// CityObject `object` but its attributes. Templates are no part of CityObjects.
void for_each_boundaries(std::string_view object,
                         const std::function<void(std::string_view)>& visit);

/// `object` with each vertex number n in its boundaries as `number_of(n)`.
std::string with_vertex_numbers(std::string_view object,
                                const std::function<std::int64_t(std::size_t)>& number_of);

/// Calls `visit(from, to, number)` with each whole number of `array` and its place.
void for_each_number(std::string_view array,
                     const std::function<void(std::size_t, std::size_t, std::size_t)>& visit);

/// What becomes of the numbers by which geometries name parts of "appearance".
struct AppearanceNumbers {
  std::function<std::int64_t(std::size_t)> material;
  std::function<std::int64_t(std::size_t)> texture;
  /// Of "vertices-texture".
  std::function<std::int64_t(std::size_t)> place;
};

/// The CityObject `object` with new numbers in "material" and "texture" of its geometries; the
/// functions are called in the order of the text. In the innermost arrays of a texture's "values"
/// the first number is the texture, the others are places (CityJSON 2.0, 6.2).
std::string with_appearance_numbers(std::string_view object, const AppearanceNumbers& numbers);

}  // namespace oriel::detail
