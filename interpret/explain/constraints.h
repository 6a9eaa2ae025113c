#pragma once

#include "interpret/pack/pack.h"

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel::rules {

/// The values of an attribute that conditions leave, and which condition set each end.
struct ValueInterval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  /// The end itself does not belong to it.
  bool is_low_open = false;
  bool is_high_open = false;
  ExprId low_by = kNoExpr;
  ExprId high_by = kNoExpr;

  [[nodiscard]] bool is_empty() const {
    return low > high || (low == high && (is_low_open || is_high_open));
  }
  [[nodiscard]] bool is_inside(const ValueInterval& other) const;
};

/// The values that a condition on one attribute of the feature itself leaves.
struct AttributeTest {
  int column = -1;
  ValueInterval interval;
};

/// What a condition says of one attribute at the params' values: `a > 1 m`, `b in 1 m .. 2 m`,
/// `host is wall`; with `is_negated` of its opposite. Nothing for every other kind of condition.
std::optional<AttributeTest> attribute_test(const Pack& pack, ExprId id, bool is_negated);

/// What must be true of a feature for which all of some conditions hold, as far as that is known
/// from attributes compared with constants, words, and classes with and without `not`.
class Constraints {
 public:
  /// All of `conditions`. A predicate that is asked for adds what all its rules have in common.
  Constraints(const Pack& pack, const std::vector<ExprId>& conditions);

  /// Two conditions that cannot hold together, the later one second; of one that contradicts itself
  /// twice the same.
  [[nodiscard]] std::optional<std::pair<ExprId, ExprId>> contradiction() const {
    return contradiction_;
  }
  /// True if the condition holds whenever these do.
  [[nodiscard]] bool imply(ExprId condition) const;

 private:
  Constraints(const Pack& pack, int depth) : pack_(&pack), depth_(depth) {}
  void add(ExprId id, bool is_negated);
  void add_interval(int column, const ValueInterval& interval);
  void add_words(const Expr& expr, ExprId id, bool is_negated);
  void add_predicate(ClassId id, ExprId by);
  void add_other(ExprId id, bool is_negated);
  void keep_common(const Constraints& other);
  [[nodiscard]] bool implies_words(const Expr& expr, bool is_negated) const;
  [[nodiscard]] bool implies(ExprId id, bool is_negated) const;
  void contradict(ExprId earlier, ExprId later);

  struct Words {
    std::set<double> allowed;
    ExprId by = kNoExpr;
  };

  const Pack* pack_;
  /// Of predicates inside predicates.
  int depth_ = 0;
  std::map<int, ValueInterval> intervals_;
  /// By column, for texts that can only be one of these.
  std::map<int, Words> words_;
  /// Conditions of other kinds, and whether each must fail.
  std::vector<std::pair<ExprId, bool>> others_;
  std::optional<std::pair<ExprId, ExprId>> contradiction_;
};

/// True if two expressions are the same but for where they stand.
bool is_same(const Pack& pack, ExprId p, ExprId q);
/// True if `q` asks of other what `p` asks of self, and the other way round; never of quantifiers.
bool is_mirrored(const Pack& pack, ExprId p, ExprId q);

}  // namespace oriel::rules
