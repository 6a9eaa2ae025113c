#include "kernel/io/gltf/colours.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace oriel::detail {

namespace {

constexpr std::array<Colour, 16> kLabelColours{{{0x0e, 0x75, 0xbd},
                                                {0x83, 0x44, 0x17},
                                                {0xc1, 0x2c, 0x71},
                                                {0x5b, 0x25, 0x35},
                                                {0xd6, 0x8a, 0x02},
                                                {0x70, 0x7c, 0x25},
                                                {0x12, 0x9c, 0x93},
                                                {0x4f, 0x41, 0x9d},
                                                {0xdf, 0xc4, 0x32},
                                                {0x39, 0x53, 0x54},
                                                {0x79, 0xb8, 0xe8},
                                                {0x9a, 0x7d, 0x61},
                                                {0xc1, 0x99, 0x87},
                                                {0xa9, 0x79, 0xf7},
                                                {0xa7, 0xcc, 0x7e},
                                                {0xe3, 0x4e, 0x8e}}};

constexpr std::array<std::pair<std::string_view, std::size_t>, 21> kUsual{
    {{"window", 0},    {"door", 1},    {"dormer", 2},  {"chimney", 3},      {"balcony", 4},
     {"stairs", 5},    {"canopy", 6},  {"railing", 7}, {"ledge", 8},        {"antenna", 9},
     {"skylight", 10}, {"garage", 11}, {"bay", 12},    {"bay window", 12},  {"oriel", 13},
     {"parapet", 14},  {"loggia", 15}, {"vent", 9},    {"solar panel", 10}, {"column", 11},
     {"terrace", 14}}};

constexpr Colour kWall{0xe7, 0xe2, 0xd8}, kRoof{0xcf, 0xc6, 0xb8}, kGround{0x8c, 0x86, 0x7c},
    kOther{0xb8, 0xb2, 0xa6};

}  // namespace

Colour colour_of_label(std::string_view label) {
  if (label == "wall") return kWall;
  if (label == "roof") return kRoof;
  if (label == "ground") return kGround;
  if (label.empty() || label == "unlabelled") return kOther;
  std::string word(label);
  std::ranges::replace(word, '_', ' ');
  const auto* const usual = std::ranges::find(kUsual, std::string_view(word),
                                              &std::pair<std::string_view, std::size_t>::first);
  if (usual != kUsual.end()) return kLabelColours[usual->second];
  std::uint32_t sum = 2166136261;  // FNV-1a
  for (const char c : label) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619;
  return kLabelColours[sum % kLabelColours.size()];
}

Colour colour_of_surface(std::string_view surface) {
  if (surface == "WallSurface") return kWall;
  if (surface == "RoofSurface") return {0xb5, 0x4a, 0x3a};
  if (surface == "GroundSurface") return kGround;
  if (surface == "Window") return kLabelColours[0];
  if (surface == "Door") return kLabelColours[1];
  return kOther;
}

std::array<std::uint8_t, 4> linear(Colour colour, std::uint8_t opacity) {
  std::array<std::uint8_t, 4> out{0, 0, 0, opacity};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = colour[i] / 255.0;
    const double value = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    out[i] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
  return out;
}

}  // namespace oriel::detail
