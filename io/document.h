#pragma once

#include "io/files/format.h"
#include "model/building.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

struct CityJsonSource;

inline constexpr std::size_t kNoFamily = static_cast<std::size_t>(-1);

/// One record of a file: a whole CityJSON, OBJ, OFF, PLY or STL file, one line of a CityJSONSeq, or
/// one Building of a CityGML file. It keeps the text it was read from, so that writing leaves every
/// byte alone that it need not change.
struct Document {
  /// The record's name in messages: the file, and for CityJSONSeq the line (`tile.city.jsonl:12`),
  /// for CityGML the line where the Building starts.
  std::string name;
  Format format = Format::cityjson;
  /// The buildings that could be read, in the order of the file. The header line of a CityJSONSeq,
  /// and that of CityGML, is a record without buildings.
  std::vector<Building> buildings;
  /// The CityJSON text and where the buildings stand in it. Of CityGML, the lines of the
  /// CityJSONSeq that it becomes; null for a Building that could not be read. Null for
  /// meshes.
  std::shared_ptr<const CityJsonSource> source;
  /// Of a line of a CityJSONSeq: its "id", and the type of the CityObject with that id.
  std::string feature_id{};
  std::string feature_type = "Building";
  /// Of each building the number of its family, those that parents and children connect; kNoFamily
  /// of an object that is no building. Empty for meshes.
  std::vector<std::size_t> families{};
};

/// The line of a CityJSONSeq that a document was read from, without its line end; empty for other
/// formats.
std::string_view source_line(const Document& document);

}  // namespace oriel
