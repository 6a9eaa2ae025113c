#include "io/files/format.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oriel {

namespace {

constexpr std::array<std::pair<std::string_view, Format>, 11> kExtensions{{
    {".json", Format::cityjson},
    {".jsonl", Format::cityjson_seq},
    {".gml", Format::citygml},
    {".citygml", Format::citygml},
    {".xml", Format::citygml},
    {".gpkg", Format::gpkg},
    {".obj", Format::obj},
    {".off", Format::off},
    {".ply", Format::ply},
    {".stl", Format::stl},
    {".glb", Format::glb},
}};

constexpr std::array<std::pair<std::string_view, Format>, 11> kNames{{
    {"cityjson", Format::cityjson},
    {"cityjsonseq", Format::cityjson_seq},
    {"citygml", Format::citygml},
    {"citygml2", Format::citygml2},
    {"citygml3", Format::citygml3},
    {"gpkg", Format::gpkg},
    {"obj", Format::obj},
    {"off", Format::off},
    {"ply", Format::ply},
    {"stl", Format::stl},
    {"glb", Format::glb},
}};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace

std::optional<Format> format_of(std::string_view path) {
  const std::string name = lower(path);
  for (const auto& [extension, format] : kExtensions)
    if (name.ends_with(extension)) return format;
  return std::nullopt;
}

std::optional<Format> parse_format(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name, &decltype(kNames)::value_type::first);
  if (found == kNames.end()) return std::nullopt;
  return found->second;
}

std::string to_string(Format format) {
  const auto* const found =
      std::ranges::find(kNames, format, &decltype(kNames)::value_type::second);
  return std::string(found->first);
}

}  // namespace oriel
