#pragma once

#include "interpret/language/parser.h"
#include "interpret/language/source.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace oriel::rules {

/// "a `window`", "an `opening`".
std::string with_article(std::string_view name, std::string_view mark = "`");

/// Says expressions in plain words, with names between backquotes as in Markdown.
class ConditionWords {
 public:
  /// `values` are the params with their values as they are written ("0.8 m").
  ConditionWords(const Source& source, std::map<std::string, std::string> values)
      : source_(&source), values_(std::move(values)) {}

  /// "`width` is at least `$narrowest` (0.3 m), and it lies in a wall".
  [[nodiscard]] std::string condition(const Syntax& syntax) const;
  /// The same of a relation's `where`, which speaks of a feature and of the other.
  [[nodiscard]] std::string pair_condition(const Syntax& syntax) const;
  /// The body of a macro, which may be used of a feature and of the others of a relation.
  [[nodiscard]] std::string macro(const Syntax& syntax) const;
  /// Of a value: "`width` × 2".
  [[nodiscard]] std::string value(const Syntax& syntax) const;

 private:
  /// Which feature a name without a scope means: the one at hand, one of a relation, or in a
  /// relation's own condition the first of the two.
  enum class Speaker { top, inside, pair };

  [[nodiscard]] std::string say(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string say_in(const Syntax& outer, const Syntax& syntax,
                                   Speaker speaker) const;
  [[nodiscard]] std::string name(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string number(const Syntax& syntax) const;
  [[nodiscard]] std::string parameter(const Syntax& syntax) const;
  [[nodiscard]] std::string is_test(const Syntax& syntax, bool is_negated, Speaker speaker) const;
  [[nodiscard]] std::string negation(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string quantifier(const Syntax& syntax, bool is_negated,
                                       Speaker speaker) const;
  [[nodiscard]] std::string others(const Syntax& syntax, bool is_plural, std::size_t where) const;
  [[nodiscard]] std::string binary(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string operand(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string call(const Syntax& syntax, Speaker speaker) const;
  [[nodiscard]] std::string joined(const Syntax& syntax, Speaker speaker, const char* word) const;

  const Source* source_;
  std::map<std::string, std::string> values_;
};

}  // namespace oriel::rules
