#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/source.h"
#include "interpret/yaml/yaml_tree.h"

#include <functional>
#include <optional>
#include <string>

namespace oriel::rules {

/// A pack as it was found by the name after `extends:`.
struct FoundPack {
  /// As places show it.
  std::string file;
  std::string text;
};

/// Finds packs that others extend; nothing if there is none of that name.
using PackFinder = std::function<std::optional<FoundPack>(const std::string& name)>;

/// How many packs may stand beneath one.
inline constexpr std::size_t kMostBeneath = 8;

/// The tree of the pack in the text of `source`, put over those that it extends, one after the
/// other; their texts are appended to `source`. Nothing and an error if one cannot be read (R200,
/// R201 …) or `extends:` makes no sense (R246).
///
/// What the upper pack says of a param or a class replaces single keys; a host, setting, relation,
/// macro, group, emission, rule or entry is replaced as a whole, by name or id; what is new comes
/// last. `{id: ID, remove: true}` takes a rule or an entry out.
std::optional<YamlNode> read_tree(Source& source, const PackFinder& find, Findings& findings);

}  // namespace oriel::rules
