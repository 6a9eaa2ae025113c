#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace oriel::detail {

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
