#pragma once

#include "kernel/io/citygml/xml_node.h"

#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace oriel::detail {

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
