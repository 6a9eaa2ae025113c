#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace oriel {

/// The file formats of buildings. CityGML is read only; STL and GLB are written only.
enum class Format { cityjson, cityjson_seq, citygml, obj, off, ply, stl, glb };

/// True for the formats that have points and faces and say nothing of buildings.
constexpr bool is_mesh(Format format) {
  return format != Format::cityjson && format != Format::cityjson_seq && format != Format::citygml;
}

/// What stdin is taken for if nobody says more: a stream.
inline constexpr Format kFormatOfStdin = Format::cityjson_seq;

/// The format that a file's name says, by its last extensions, upper or lower case: `.city.json`
/// and `.json`, `.city.jsonl` and `.jsonl`, `.gml`, `.citygml` and `.xml`, `.obj`, `.off`, `.ply`,
/// `.stl`, `.glb`.
/// Nothing for any other name, and for "-".
std::optional<Format> format_of(std::string_view path);

/// The format of that name, as `--from` and `--to` take it: the names that `to_string` gives.
std::optional<Format> parse_format(std::string_view name);

/// "cityjson", "cityjsonseq", "citygml", "obj", "off", "ply", "stl", "glb".
std::string to_string(Format format);

}  // namespace oriel
