#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/lexer.h"
#include "interpret/language/source.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// An expression as it was written: no name is looked up yet, no type known.
struct Syntax {
  enum class Kind {
    number,      ///< `number`, in the unit `name` ("" for none)
    parameter,   ///< $name
    name,        ///< [scope.]name: an attribute, a macro, or a word compared with a text
    call,        ///< name(children…): abs, min, max, sqrt
    quantifier,  ///< name(relation [where children[0]]): exists, none, count, all
    aggregate,   ///< name(children[0] of relation [where children[1]]): min, max, mean
    distance,    ///< distance_along(other)
    group_gap,   ///< gap(members)
    is_test,     ///< [scope] is name, or [scope.]host is name
    negate,      ///< - children[0]
    negation,    ///< not children[0]
    binary,      ///< children[0] `symbol` children[1]: arithmetic and comparisons
    all_of,      ///< children joined by `and`
    any_of,      ///< children joined by `or`
    range_test,  ///< children[0] in children[1] .. children[2]
    list_test,   ///< children[0] in [children[1]…]
    similarity   ///< children[0] ~ children[1] by children[2]
  };
  /// Which feature a name speaks of: `here` is the feature at hand, inside `where` the other one.
  enum class Scope { here, self, other };

  Kind kind = Kind::name;
  SourceSpan span{};
  /// Of the name alone, or of the operator's symbol.
  SourceSpan name_span{};
  std::string name{};
  std::string relation{};
  SourceSpan relation_span{};
  Scope scope = Scope::here;
  bool is_of_host = false;
  double number = 0;
  Token::Kind symbol = Token::Kind::end;
  std::vector<Syntax> children{};
  /// Levels of operators beneath, itself included.
  int height = 1;
};

/// The name that stands for N of the target scale 1 : N under `generalise:`.
inline constexpr const char* kScaleName = "scale";

/// `lo .. hi`.
struct RangeSyntax {
  Syntax low;
  Syntax high;
};

/// What one expression may be at most.
inline constexpr std::size_t kLongestExpression = 1000;
inline constexpr int kDeepestExpression = 64;

/// The expression at `where` in the text of `findings.source()`, or nothing and an error: R220
/// (what was found and what was expected), R222 (too long or too deep), R233 (unknown unit).
std::optional<Syntax> parse_expression(SourceSpan where, Findings& findings);

/// The range `lo .. hi` at `where`, with the same errors.
std::optional<RangeSyntax> parse_range(SourceSpan where, Findings& findings);

/// The words that expressions are made of; nothing else can carry their names.
const std::vector<std::string>& reserved_words();

}  // namespace oriel::rules
