#pragma once

#include "interpret/language/lexer.h"
#include "interpret/language/source.h"
#include "studio/editing/cursor/yaml_path.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// What a word of a pack names.
enum class WordSort {
  param,
  class_name,
  relation,
  group,
  rule,
  entry,
  fixture,
  pack,
  value_name,  ///< in an expression: an attribute or a macro
  macro,       ///< where it is declared
  attribute,   ///< outside expressions, as in tests
  text_value,  ///< what a text attribute can be
  facet,       ///< wall, roof, ground after `host is`
  unit,
  function,  ///< and quantifiers
  language,  ///< and, or, not, is, in …
};

struct PackWord {
  WordSort sort = WordSort::language;
  std::string name{};
  SourceSpan span{};
  /// The name is declared here.
  bool is_declaration = false;
  /// Of a text value: the attribute.
  std::string attribute{};
};

/// The tokens of the expression at `where`, up to its first fault, without an end token.
std::vector<Token> tokens_of(const Source& source, SourceSpan where);

/// The text attribute that the value at the end of `tokens` is compared with, as after `sense = `
/// or `sense in [hole, `; or nothing.
std::string compared_attribute(const std::vector<Token>& tokens);

/// All words of the expression at `where`.
std::vector<PackWord> expression_words(const Source& source, SourceSpan where);

/// All words of a pack, or of the tests of one, that name something, in their order.
std::vector<PackWord> pack_words(const YamlNode& root, const Source& source);

}  // namespace oriel::rules
