#pragma once

#include "io/json/text.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

/// The vocabulary of an element: its XML namespace without the version, as far as CityGML 1.0, 2.0
/// and 3.0 and the GML in them go.
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

/// The generic attribute that says that the gml:id of an object stands for an id that no gml:id can
/// be (xml_id); the writer gives it.
inline constexpr std::string_view kObjectId = "oriel_object_id";

/// The id of an object: its gml:id, or the one that this stands for. Empty if it has none.
std::string object_id(const XmlNode& node);

/// True for an element of CityGML, false for one of GML and of extensions.
inline bool is_city(const XmlNode& node) {
  return node.vocabulary != Vocabulary::gml && node.vocabulary != Vocabulary::other;
}

/// True for a property that holds a boundary surface, or an opening or filling of one.
inline bool holds_boundary(const XmlNode& node) {
  return is_city(node) &&
         (node.name == "boundedBy" || node.name == "boundary" || node.name == "opening" ||
          node.name == "fillingSurface" || node.name == "filling");
}

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

/// The elements of a building by their gml:id, and the values of its properties: GML writes a value
/// either into its property or names it there by xlink:href="#id".
class XmlLinks {
 public:
  /// `member` must outlive the links and stay where it is.
  explicit XmlLinks(const XmlNode& member);

  /// The values of a property: its child elements, else what its link names. E207 for a link to an
  /// id that stands twice, E211 for one that leads out of the building. A property that is empty
  /// has none.
  std::vector<const XmlNode*> values_of(const XmlNode& property);

  /// What was wrong with the last link that led nowhere.
  [[nodiscard]] const std::optional<NodeFault>& fault() const { return fault_; }

  /// The first element whose gml:id stands before it already, or null.
  [[nodiscard]] const XmlNode* duplicate() const { return duplicate_; }
  /// The number of elements in the building.
  [[nodiscard]] std::size_t node_count() const { return count_; }

  /// How deep properties may be nested, those behind links included; without links the depth of an
  /// XML document is limited anyway.
  static constexpr int kMaxDepth = 500;
  /// How often elements may be visited, on average: by the solid and the boundary surfaces of some
  /// levels of detail, from both sides. Links to links that multiply are stopped there.
  static constexpr std::size_t kVisits = 16;
  /// E212 for the property whose value would be one visit too many.
  static NodeFault too_many(const XmlNode& property);
  /// E503 for a property that is nested deeper.
  static NodeFault too_deep(const XmlNode& property);

 private:
  struct Target {
    const XmlNode* node = nullptr;
    bool is_twice = false;
  };

  void add(const XmlNode& node);

  std::unordered_map<std::string_view, Target> target_of_;
  std::optional<NodeFault> fault_;
  const XmlNode* duplicate_ = nullptr;
  std::size_t count_ = 0;
};

}  // namespace oriel::detail
