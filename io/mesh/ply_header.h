#pragma once

#include "io/json/text.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

enum class PlyEncoding : std::uint8_t { words, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// How many bytes a number of the type takes in a binary file.
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  /// Of a list: what its length is written as.
  std::optional<PlyType> length_type{};

  [[nodiscard]] bool is_list() const { return length_type.has_value(); }
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties{};

  /// The place of a property, or nothing.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
};

/// What the header of a PLY file promises.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::words;
  /// In the order of the file; each with a property; none twice.
  std::vector<PlyElement> elements{};
  /// "comment feature 3 house window_w12" names feature 3.
  std::map<long long, std::string> features{};
  /// Where the first element starts.
  std::size_t end = 0;
};

/// Reads the header: E107 if the text does not start with ply, E102 if it is blank, E110 for
/// anything else, with line and column. In binary files lengths of lists are whole numbers. Source:
/// Turk, The PLY Polygon File Format, 1994.
Checked<PlyHeader> read_ply_header(std::string_view text, const TextName& name);

}  // namespace oriel::detail
