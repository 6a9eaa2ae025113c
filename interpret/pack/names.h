#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "interpret/pack/pack.h"

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// A named condition or value; it is checked anew wherever it is used.
struct Macro {
  std::string name;
  Syntax body;
  SourceSpan span;
  bool is_used = false;
  /// True while it is being expanded: a macro that meets itself is an error.
  bool is_open = false;
};

/// What expressions may name, besides what stands in the pack: known only while it is loaded.
struct Names {
  std::vector<Macro> macros;
  /// Macros whose body is no expression: their uses are not reported again.
  std::vector<std::string> broken_macros;
  /// Sections that could not be read ("classes"): what they would have named is not reported.
  std::set<std::string, std::less<>> unread;
  /// Classes that nothing is like and that were reported: the other places are not.
  std::set<std::string> missing_classes;
  /// The same for params; parallel to Pack::params.
  std::vector<std::string> broken_params;
  std::vector<bool> is_param_used;
  /// Relations of the pack that are no relations: their uses are not reported again.
  std::vector<std::string> broken_relations;
  /// Numbers of the relations that something leads over.
  std::set<int> used_relations;
};

/// The number of the relation called `name`, of the pack or else built in, or -1.
int relation_number(const Pack& pack, std::string_view name);
/// All of them, in the order of their numbers.
std::vector<std::string> relation_names(const Pack& pack);

/// The element of `list` called `name`: its index, or -1.
template <class Named>
int index_of(const std::vector<Named>& list, std::string_view name) {
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i].name == name) return static_cast<int>(i);
  return -1;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const Named& element : list) names.push_back(element.name);
  return names;
}

/// A lower-case identifier: a letter, then letters, digits and _.
bool is_identifier(std::string_view text);

/// Dotted identifiers such as `door.ground`.
bool is_rule_id(std::string_view text);

/// What a feature is written as.
struct Role {
  /// Null: it is not written.
  const Emission* emission = nullptr;
  /// The class that has the emission: the label or what it is a kind of.
  std::string label;
  std::string subclass;

  [[nodiscard]] bool is_installation() const {
    return emission != nullptr && emission->type == "BuildingInstallation";
  }
  [[nodiscard]] bool is_opening() const { return emission != nullptr && !is_installation(); }
};

/// Of a feature with that label; of none without one.
Role role_of(const Pack& pack, std::string_view label);

}  // namespace oriel::rules
