#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace oriel::detail {

/// Red, green and blue as screens have them (sRGB).
using Colour = std::array<std::uint8_t, 3>;

/// The opacity of what nothing shines through.
inline constexpr std::uint8_t kOpaque = 255;

/// The colour of a label: that of the usual ones is the same as in the studio
/// (studio/page/src/scene/palette.json), of others one of the same colours, by the label's letters.
Colour colour_of_label(std::string_view label);

/// The colour of a type of surface: "WallSurface", "RoofSurface", "GroundSurface", "Window",
/// "Door".
Colour colour_of_surface(std::string_view surface);

/// The same as glTF has colours of vertices: linear, with an opacity.
std::array<std::uint8_t, 4> linear(Colour colour, std::uint8_t opacity = kOpaque);

}  // namespace oriel::detail
