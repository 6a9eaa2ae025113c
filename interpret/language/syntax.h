#pragma once

#include "interpret/language/lexer.h"
#include "interpret/language/source.h"

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
  /// Of whom a name speaks: `here` is the feature at hand, inside `where` the other one.
  enum class Scope { here, self, other };

  Kind kind = Kind::name;
  Span span{};
  /// Of the name alone, or of the operator's symbol.
  Span name_span{};
  std::string name{};
  std::string relation{};
  Span relation_span{};
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

}  // namespace oriel::rules
