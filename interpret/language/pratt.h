#pragma once

#include "interpret/language/syntax.h"
#include "interpret/language/token_stream.h"

#include <utility>
#include <vector>

namespace oriel::rules {

/// How tightly operators bind, loosest first. `not` stands between `and` and the comparisons.
enum class Power { loosest, disjunction, conjunction, comparison, sum, product };

/// A Pratt parser: an operand, then operators as long as they bind tighter than what waits.
/// Errors end it with ParseStop.
class Pratt {
 public:
  Pratt(std::vector<Token> tokens, Findings& findings) : tokens_(std::move(tokens), findings) {}

  /// An expression of operators that bind tighter than `least`.
  Syntax expression(Power least);
  /// `lo .. hi`.
  RangeSyntax range();
  void expect_end();

 private:
  using Kind = Syntax::Kind;

  /// `node` with its children in place, its span drawn over them and its height counted.
  Syntax finish(Syntax node, std::vector<Syntax> children);
  void check_depth(int depth, Span where);

  // Operands: pratt_operands.cpp.
  Syntax operand();
  Syntax number();
  Syntax parameter();
  Syntax negation();
  Syntax negative();
  Syntax in_brackets();
  Syntax word();
  Syntax scoped(Syntax::Scope scope, Span begin);
  Syntax is_test(Syntax::Scope scope, bool is_of_host, Span begin);
  Syntax plain_name(Syntax::Scope scope, Span begin);
  Syntax call();
  Syntax measure();
  Syntax quantifier();
  Syntax aggregate(Syntax node, Syntax value);
  void relation_of(Syntax& node, std::vector<Syntax>& children);

  // Operators: pratt.cpp.
  Syntax infix(Syntax left, Power power);
  Syntax logical(Syntax left, Kind kind, Power power);
  Syntax membership(Syntax left);
  Syntax similarity(Syntax left);
  Syntax binary(Syntax left, Power power);

  TokenStream tokens_;
  int depth_ = 0;
};

}  // namespace oriel::rules
