#pragma once

#include "interpret/yaml/yaml_tree.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// A comment of a YAML text, or an empty line, for which `text` is empty.
struct YamlComment {
  std::size_t offset = 0;
  /// With its #.
  std::string text;
  /// Nothing stands before it on its line.
  bool is_own_line = false;
};

/// The comments and empty lines of `text`, in their order; `root` is its tree. Of several empty
/// lines the first.
std::vector<YamlComment> find_comments(const YamlNode& root, std::string_view text);

}  // namespace oriel::rules
