#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// One table of colours for pages, tiles and pictures: io/mesh/palette.json.
namespace oriel {

/// Red, green and blue as screens have them (sRGB).
using Colour = std::array<std::uint8_t, 3>;

/// Finds the colour of a label: usual ones have their own, others one of the same colours, by the
/// label's letters.
Colour colour_of_label(std::string_view label);

/// Finds the colour of a type of surface: "WallSurface", "RoofSurface", "GroundSurface", "Window",
/// "Door".
Colour colour_of_surface(std::string_view surface);

/// True if a label names a part, not a plain surface (wall, roof, ground …) or what has no label.
bool is_label_of_part(std::string_view label);

}  // namespace oriel
