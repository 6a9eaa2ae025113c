#pragma once

#include "studio/editing/cursor/yaml_path.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// A key, or a fixed value, that pack_schema() has somewhere.
struct SchemaWord {
  std::string name{};
  std::string meaning{};
  bool is_required = false;
};

/// The keys that the map at `path` of a pack can have.
std::vector<SchemaWord> schema_keys(const YamlPath& path);

/// The values that are listed for `path`, true and false among them; nothing where any text can
/// stand.
std::vector<SchemaWord> schema_values(const YamlPath& path);

/// What the schema says of the value at `path`, or nothing.
std::string schema_meaning(const YamlPath& path);

}  // namespace oriel::rules
