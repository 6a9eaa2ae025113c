#pragma once

#include "interpret/yaml/grammar.h"
#include "studio/editing/cursor/yaml_path.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// A key, or a fixed value, that a grammar has somewhere.
struct SchemaWord {
  std::string name{};
  std::string meaning{};
  bool is_required = false;
};

/// The keys that the map at `path` can have.
std::vector<SchemaWord> schema_keys(const Grammar& grammar, const YamlPath& path);

/// The values that are listed for `path`, true and false among them; nothing where any text can
/// stand.
std::vector<SchemaWord> schema_values(const Grammar& grammar, const YamlPath& path);

/// What the grammar says of the value at `path`, or nothing.
std::string schema_meaning(const Grammar& grammar, const YamlPath& path);

}  // namespace oriel::rules
