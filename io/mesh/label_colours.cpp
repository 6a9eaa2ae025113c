#include "io/mesh/label_colours.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel {

namespace detail {
/// The text of io/mesh/palette.json.
extern const std::string_view kPaletteJson;
}  // namespace detail

namespace {

/// What palette.json has.
struct Palette {
  std::vector<Colour> labels;
  std::map<std::string, std::size_t, std::less<>> usual;
  std::map<std::string, Colour, std::less<>> surfaces;
};

Colour colour_of(const std::string& hex) {
  Colour colour;
  for (std::size_t i = 0; i < colour.size(); ++i)
    colour[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(1 + 2 * i, 2), nullptr, 16));
  return colour;
}

/// "outer ceiling" as the label of faces without a feature: "outerceiling".
std::string without_spaces(std::string name) {
  std::erase(name, ' ');
  return name;
}

const Palette& palette() {
  static const Palette read = [] {
    const auto json = nlohmann::json::parse(detail::kPaletteJson);
    Palette out;
    for (const auto& colour : json.at("labels")) out.labels.push_back(colour_of(colour));
    json.at("usual").get_to(out.usual);
    for (const char* section : {"surfaces", "plain"})
      for (const auto& [name, colour] : json.at(section).items())
        out.surfaces[without_spaces(name)] = colour_of(colour);
    return out;
  }();
  return read;
}

}  // namespace

bool is_label_of_part(std::string_view label) {
  return !label.empty() && label != "unlabelled" && !palette().surfaces.contains(label);
}

Colour colour_of_label(std::string_view label) {
  const auto surface = palette().surfaces.find(label);
  if (surface != palette().surfaces.end()) return surface->second;
  if (!is_label_of_part(label)) return palette().surfaces.at("other");
  std::string word(label);
  std::ranges::replace(word, '_', ' ');
  const auto usual = palette().usual.find(word);
  if (usual != palette().usual.end()) return palette().labels.at(usual->second);
  std::uint32_t sum = 2166136261;  // FNV-1a
  for (const char c : label) sum = (sum ^ static_cast<unsigned char>(c)) * 16777619;
  return palette().labels[sum % palette().labels.size()];
}

Colour colour_of_surface(std::string_view surface) {
  if (surface == "WallSurface") return colour_of_label("wall");
  if (surface == "RoofSurface") return {0xb5, 0x4a, 0x3a};
  if (surface == "GroundSurface") return colour_of_label("ground");
  if (surface == "Window" || surface == "Door")
    return palette().labels[surface == "Window" ? 0 : 1];
  return colour_of_label("");
}

}  // namespace oriel
