#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A name that packs can say, with what a reader must know to use it.
struct VocabularyWord {
  std::string name;
  /// Of an attribute "m", "m2", "m3", "deg", "count", "ratio", "text" or "yes/no"; else empty.
  std::string unit;
  std::string meaning;
  /// A condition, or what stands after `do:`; it can be put into a pack as it is.
  std::string example;
  /// Of a text, what it can be; of an operator, its arguments, each with kind and meaning.
  std::vector<std::string> values;
  /// What other systems call it.
  std::vector<std::string> synonyms;
};

/// The tables that the engine itself uses, for people: attributes of features and of surfaces by
/// column, relations in their order, operators by name.
std::vector<VocabularyWord> attribute_words();
std::vector<VocabularyWord> surface_attribute_words();
std::vector<VocabularyWord> relation_words();
std::vector<VocabularyWord> operator_words();

/// The one of `words` called `name`, else the one that has it as a synonym.
std::optional<VocabularyWord> find_word(const std::vector<VocabularyWord>& words,
                                        std::string_view name);

}  // namespace oriel
