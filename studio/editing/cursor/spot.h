#pragma once

#include "studio/editing/cursor/yaml_path.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// Where somebody writes in a YAML text: a key or a value that may not be complete.
struct WritingSpot {
  /// To the value, or of a key to the value that it will have; its last step is then what is
  /// written of the key so far.
  YamlPath path{};
  bool is_key = false;
  /// What is written of it, up to the place, and where that begins in the text.
  std::string written{};
  std::size_t begin = 0;
  /// Of a key: the other keys of its map.
  std::vector<std::string> siblings{};
};

/// What `offset` in `text` may be meant as: a key, a value, or both where a list may have either.
/// Only what stands before `offset` counts, and of that what can be read: the rest of the text may
/// be broken. Nothing in comments, and in texts over several lines.
std::vector<WritingSpot> spots_at(std::string_view text, std::size_t offset);

}  // namespace oriel::rules
