#pragma once

#include "interpret/language/quantity.h"
#include "interpret/language/source.h"

#include <cstdint>
#include <vector>

namespace oriel::rules {

/// Three-valued logic in this order, so that `and` is the minimum, `or` the maximum and `not`
/// 2 - x.
enum class Truth : std::uint8_t { no = 0, unknown = 1, yes = 2 };

constexpr Truth negated(Truth t) { return static_cast<Truth>(2 - static_cast<int>(t)); }
constexpr Truth truth_of(bool value) { return value ? Truth::yes : Truth::no; }

/// The type of an expression; a number has a dimension besides.
enum class Type { yes_no, number, text };

enum class Op {
  // Numbers and texts; a text is the number of its word, a missing value NaN.
  constant,
  parameter,   ///< index: of the param
  attribute,   ///< index: column
  map_length,  ///< args[0] millimetres on the map, in metres at the scale
  scale,       ///< N of the target scale 1 : N
  negate,
  add,
  subtract,
  multiply,
  divide,
  absolute,
  minimum,
  maximum,
  square_root,
  count,  ///< quantifier
  least,  ///< aggregates: quantifiers over a value: index: relation
  greatest,
  mean,
  // Yes or no.
  flag,  ///< index: column of a yes/no attribute
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  in_range,  ///< args: value, low, high
  in_list,   ///< args: value, members…
  similar,   ///< args: x, y, tolerance
  negation,
  all_of,
  any_of,
  is_class,  ///< index: class
  facet_is,  ///< index: kind of host facet (HostKind)
  exists,    ///< quantifiers: index: relation
  none,
  all
};

/// What a facet that hosts features is.
enum class HostKind { wall, roof, ground, none };

using ExprId = int;
inline constexpr ExprId kNoExpr = -1;

/// Features an expression speaks of: level 0 is the one to be labelled, level k the other one of
/// the k-th quantifier around it.
inline constexpr int kMostLevels = 4;

/// A typed expression: an element of ExprList, whose arguments stand before it.
struct Expr {
  Op op = Op::constant;
  Type type = Type::number;
  Dimension dimension{};
  std::vector<ExprId> args{};
  double number = 0;
  int index = -1;
  /// Of an attribute or a test: the level it reads. Of a quantifier: the level of its self.
  int level = 0;
  /// Bit k: a feature of level k is read.
  unsigned levels = 0;
  /// Levels of operators beneath, itself included.
  int height = 1;
  /// Of a quantifier: the conditions on the other feature alone, and the remaining ones; kNoExpr if
  /// none.
  ExprId filter = kNoExpr;
  ExprId join = kNoExpr;
  /// Of an aggregate: the number taken from every other feature.
  ExprId value = kNoExpr;
  /// Of a test for a class: it reads the memberships of the round before (`iterate:`).
  bool is_previous = false;
  /// Where it was written, for excerpts and explanations.
  SourceSpan span{};
};

/// All expressions of a pack.
using ExprList = std::vector<Expr>;

/// True if its value is the same for all features.
inline bool is_constant(const Expr& expr) { return expr.levels == 0; }

inline bool is_aggregate(Op op) { return op == Op::least || op == Op::greatest || op == Op::mean; }

/// True if it looks at other features through a relation.
inline bool is_quantifier(Op op) {
  return op == Op::count || op == Op::exists || op == Op::none || op == Op::all || is_aggregate(op);
}

/// The comparison that says the same with its sides exchanged.
constexpr Op mirrored(Op op) {
  switch (op) {
    case Op::less:
      return Op::greater;
    case Op::less_equal:
      return Op::greater_equal;
    case Op::greater:
      return Op::less;
    case Op::greater_equal:
      return Op::less_equal;
    default:
      return op;
  }
}

}  // namespace oriel::rules
