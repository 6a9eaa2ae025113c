#pragma once

#include <string>
#include <string_view>

namespace oriel::rules {

/// What is open at the end of the begin of a YAML text.
struct OpenEnds {
  /// The brackets that would close what is open, innermost first, such as `]}`.
  std::string closers{};
  char quote = '\0';  ///< the text that is being written is in quotes of this kind
  bool is_comment = false;
  bool is_literal = false;  ///< it is among the lines of a text after `|` or `>`
  /// What is being written stands after its key; else it is a key, or an item of a list.
  bool is_value = false;
};

/// Reads `text`, which begins with a line that is not indented. Of a text that is no YAML the
/// answer is a guess.
OpenEnds open_ends_of(std::string_view text);

}  // namespace oriel::rules
