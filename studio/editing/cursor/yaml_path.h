#pragma once

#include "interpret/yaml/yaml_tree.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// A step from a node of a YAML tree to one in it: the value of a key, or an item of a list.
struct YamlStep {
  std::string key{};
  int index = -1;  ///< -1: a key

  [[nodiscard]] bool is_key() const { return index < 0; }
};

using YamlPath = std::vector<YamlStep>;

/// Calls `visit` for every key and every value of the tree in their order, each with its path; that
/// of a key is the path of its value.
using YamlVisitor = std::function<void(const YamlNode&, const YamlPath&, bool is_key)>;
void visit_yaml(const YamlNode& root, const YamlVisitor& visit);

/// What stands in a pack, or in the tests of one, at the end of a path.
enum class YamlPlace {
  other,
  // Keys, and ids, that declare a name.
  new_param,
  new_class,
  new_macro,
  new_relation,
  new_group,
  new_rule,
  new_entry,
  // Names that are declared elsewhere.
  class_name,
  label,     ///< of tests: a class, `unknown`, or either after `not`
  target,    ///< after `for:`
  relation,  ///< with blanks or _ between its words
  group_name,
  rule_name,
  pack_name,
  attribute_name,
  fixture_name,
  outcome,  ///< of tests: fails at "condition"
  // Expressions.
  condition,          ///< on a feature
  surface_condition,  ///< on a polygon
  pair_condition,     ///< on self and other
  map_condition,      ///< under `generalise:`
  macro_body,
  constant,
  map_constant,
};

/// What stands at `path`: the key at its end, or the value.
YamlPlace place_of(const YamlPath& path, bool is_key);

bool is_expression(YamlPlace place);

}  // namespace oriel::rules
