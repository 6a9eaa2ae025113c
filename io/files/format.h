#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace oriel {

/// The file formats of buildings. `citygml` is what is read, of whatever version; the versions that
/// are written have names of their own. GeoPackage and GLB are written only.
enum class Format {
  cityjson,
  cityjson_seq,
  citygml,
  citygml2,
  citygml3,
  gpkg,
  obj,
  off,
  ply,
  stl,
  glb
};

/// True for the formats that have points and faces and say nothing of buildings.
constexpr bool is_mesh(Format format) {
  return format == Format::obj || format == Format::off || format == Format::ply ||
         format == Format::stl || format == Format::glb;
}

/// What a file of that name or format is when it is written: of CityGML version 2.0, which most
/// programs read.
constexpr Format as_written(Format format) {
  return format == Format::citygml ? Format::citygml2 : format;
}

/// CityGML of a version that is written.
constexpr bool is_written_citygml(Format format) {
  return format == Format::citygml2 || format == Format::citygml3;
}

/// False for the formats that are written only.
constexpr bool is_readable(Format format) {
  return !is_written_citygml(format) && format != Format::gpkg && format != Format::glb;
}

/// What stdin is taken for if nobody says more: a stream.
inline constexpr Format kFormatOfStdin = Format::cityjson_seq;

/// The format that a file's name says, by its last extensions, upper or lower case: `.city.json`
/// and `.json`, `.city.jsonl` and `.jsonl`, `.gml`, `.citygml` and `.xml`, `.gpkg`, `.obj`, `.off`,
/// `.ply`, `.stl`, `.glb`. Nothing for any other name, and for "-".
std::optional<Format> format_of(std::string_view path);

/// The format of that name, as `--from` and `--to` take it: the names that `to_string` gives.
std::optional<Format> parse_format(std::string_view name);

/// "cityjson", "cityjsonseq", "citygml", "citygml2", "citygml3", "gpkg", "obj", "off", "ply",
/// "stl", "glb".
std::string to_string(Format format);

}  // namespace oriel
