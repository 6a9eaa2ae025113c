#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/source.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// What a pack may be at most: it may come from a stranger.
inline constexpr std::size_t kMostBytes = 1024 * 1024;
inline constexpr std::size_t kMostYamlDepth = 64;
inline constexpr std::size_t kMostYamlNodes = 100'000;

struct YamlEntry;

/// A node of a YAML document with its place in the text.
struct YamlNode {
  enum class Kind { null, scalar, sequence, map };
  Kind kind = Kind::null;
  std::string text;       ///< of a scalar
  bool is_plain = false;  ///< a scalar without quotes
  /// A scalar that stands in the text letter by letter on one line, so that `span` counts in it.
  bool is_verbatim = false;
  /// Of a scalar without its quotes; of a sequence or map only where it begins.
  SourceSpan span;
  /// The key whose value this is, or one of the items of its value; empty at the top.
  std::string of_key;
  std::vector<YamlNode> items;
  std::vector<YamlEntry> entries;
};

/// One `key: value` of a map; keys are scalars.
struct YamlEntry {
  YamlNode key;
  YamlNode value;
};

/// Finds the value of a key of a map; null if there is none.
YamlNode* find_value(YamlNode& map, std::string_view key);
const YamlNode* find_value(const YamlNode& map, std::string_view key);

/// The one document at `where` in the text of `findings.source()`, or nothing and an error: R201
/// for what is no YAML, R203 for anchors, aliases, tags and further documents, R211 for a key that
/// is no text, R213 for a text beyond the limits above. A repeated key is an error R202 and both
/// stay.
std::optional<YamlNode> parse_yaml(SourceSpan where, Findings& findings);

/// The bytes of a file, at most one more than a pack may have; nothing if it cannot be read.
std::optional<std::string> read_file(const std::string& path);

/// The offset of the quote that closes the one at `begin`, or npos.
std::size_t find_closing_quote(std::string_view text, std::size_t begin);

}  // namespace oriel::rules
