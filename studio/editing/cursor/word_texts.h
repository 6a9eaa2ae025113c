#pragma once

#include "studio/editing/layers.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// What editors show of a word.
struct WordText {
  std::string sort{};    ///< "attribute", "param", "class" …
  std::string detail{};  ///< on its line: the unit, the value
  std::string meaning{};

  /// "parapet: param, 0.9 m in 0.6 m .. 1.1 m" and below it the meaning.
  [[nodiscard]] std::string hover(std::string_view name) const;
};

/// Of a name that a pack declares.
WordText text_of(const DeclaredName& declared);

/// Of what every pack can say; nothing in it for words that there are not.
WordText text_of_attribute(std::string_view name);
WordText text_of_relation(std::string_view name);
WordText text_of_operator(std::string_view name);
WordText text_of_function(std::string_view name);
WordText text_of_unit(std::string_view name);
WordText text_of_language(std::string_view name);

/// Those that can be called, with how; units; and words between operands.
const std::vector<std::string>& function_names();
const std::vector<std::string>& quantifier_names();

/// How a function is called, up to what comes into its brackets: "exists(", "abs(".
std::string call_of(std::string_view function);

}  // namespace oriel::rules
