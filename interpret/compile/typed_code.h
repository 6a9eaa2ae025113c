#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "interpret/pack/pack.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// "a length", "yes or no", "a text".
std::string describe(const Expr& expr);

/// True for a number that was written without a unit.
bool is_bare_number(const Syntax& syntax);

/// Op::less for <.
Op op_of(Token::Kind symbol);

/// Adds typed expressions to `pack.code`. Operators take operands that are typed already, kNoExpr
/// where one is wrong, and check that their dimensions fit together; they return kNoExpr where they
/// do not: R230 dimensions differ, R231 a unit is missing, R212 an empty range, R222 too deep.
class TypedCode {
 public:
  TypedCode(Pack& pack, Findings& findings) : pack_(&pack), findings_(&findings) {}

  [[nodiscard]] const Expr& at(ExprId id) const {
    return pack_->code[static_cast<std::size_t>(id)];
  }
  ExprId add(Expr expr);
  /// What reads the feature of expr.level.
  ExprId add_of_feature(Expr expr);
  ExprId fail(Code code, SourceSpan where, std::string sentence);
  [[nodiscard]] std::string_view text_of(const Syntax& syntax) const;

  /// A word that a text is compared with.
  ExprId word(const std::string& text, SourceSpan span);
  /// Between the middles of the lower edges of two features in their facade: sqrt((self.along -
  /// other.along)^2 + (self.base_height - other.base_height)^2).
  ExprId distance_along(SourceSpan span, int self, int other);
  /// Of numbers; `operands` are the children of `syntax` in their order.
  ExprId negate(const Syntax& syntax, ExprId operand);
  ExprId call(const Syntax& syntax, std::vector<ExprId> operands);
  ExprId arithmetic(const Syntax& syntax, std::vector<ExprId> operands);
  ExprId comparison(const Syntax& syntax, std::vector<ExprId> operands);
  ExprId range(const Syntax& syntax, std::vector<ExprId> operands);
  ExprId similarity(const Syntax& syntax, std::vector<ExprId> operands);
  /// A quantifier or an aggregate, whose value is typed, with the conditions of `where` (kNoExpr:
  /// none). Those on the other feature alone are pushed out of the join: they are evaluated once
  /// for every feature, not once for every pair.
  ExprId quantifier(Expr expr, ExprId where);
  /// Of conditions.
  ExprId logic(const Syntax& syntax, Op op, std::vector<ExprId> operands);

  /// True if both are numbers of one dimension.
  bool expect_same(const Syntax& left, ExprId left_id, const Syntax& right, ExprId right_id);

 private:
  ExprId add_operator(Op op, Dimension dimension, std::vector<ExprId> operands, SourceSpan span);
  bool report_missing_unit(const Syntax& number, const Syntax& other, Dimension wanted);
  bool report_param_without_unit(const Syntax& param, const Syntax& other, Dimension wanted);

  Pack* pack_;
  Findings* findings_;
};

}  // namespace oriel::rules
