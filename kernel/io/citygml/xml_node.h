#pragma once

#include "kernel/io/json/text.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::detail {

/// The vocabulary of an element: its XML namespace without the version, as far as CityGML 2.0 and
/// 3.0 and the GML in them go.
enum class Vocabulary : std::uint8_t { other, gml, core, building, construction, generics };

/// An element of a CityGML file with all that is in it.
struct XmlNode {
  Vocabulary vocabulary = Vocabulary::other;
  /// Counted from 1; in bytes.
  int line = 0;
  int column = 0;
  /// The name without prefix.
  std::string name;
  /// The characters directly in the element, in one.
  std::string text;
  /// Those that are read: id (gml:id), href (xlink:href), srsName, srsDimension, orientation, name.
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlNode> children;

  /// The value of an attribute, empty if it is not there.
  [[nodiscard]] std::string_view attribute(std::string_view key) const {
    for (const auto& [name_of, value] : attributes)
      if (name_of == key) return value;
    return {};
  }
  [[nodiscard]] std::string_view id() const { return attribute("id"); }
};

/// A finding and the element it is about.
struct NodeFault {
  Fault fault;
  const XmlNode* node = nullptr;
};

/// `text` without XML's white space around it.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t from = text.find_first_not_of(kSpace);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kSpace) - from + 1);
}

}  // namespace oriel::detail
