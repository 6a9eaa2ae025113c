#include "interpret/compile/typed_code.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/quantity.h"
#include "interpret/pack/names.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Dimensions beyond this power have no use and would make messages absurd.
constexpr int kHighestPower = 9;

constexpr Dimension kLength{1, 0}, kArea{2, 0};

bool has_wrong(const std::vector<ExprId>& operands) {
  return std::ranges::find(operands, kNoExpr) != operands.end();
}

}  // namespace

std::string describe(const Expr& expr) {
  if (expr.type == Type::text) return "a text";
  return expr.type == Type::yes_no ? "yes or no" : describe(expr.dimension);
}

bool is_bare_number(const Syntax& syntax) {
  if (syntax.kind == Syntax::Kind::negate) return is_bare_number(syntax.children[0]);
  return syntax.kind == Syntax::Kind::number && syntax.name.empty();
}

Op op_of(Token::Kind symbol) {
  switch (symbol) {
    case Token::Kind::less:
      return Op::less;
    case Token::Kind::less_equal:
      return Op::less_equal;
    case Token::Kind::greater:
      return Op::greater;
    case Token::Kind::greater_equal:
      return Op::greater_equal;
    case Token::Kind::equal:
      return Op::equal;
    case Token::Kind::not_equal:
      return Op::not_equal;
    case Token::Kind::plus:
      return Op::add;
    case Token::Kind::minus:
      return Op::subtract;
    case Token::Kind::star:
      return Op::multiply;
    default:
      return Op::divide;
  }
}

ExprId TypedCode::add(Expr expr) {
  for (const ExprId arg : expr.args) {
    expr.levels |= at(arg).levels;
    expr.height = std::max(expr.height, at(arg).height + 1);
  }
  if (expr.height > kDeepestExpression)
    return fail(Code::R222, expr.span,
                "with its macros this expression nests deeper than 64 levels");
  pack_->code.push_back(std::move(expr));
  return static_cast<ExprId>(pack_->code.size()) - 1;
}

ExprId TypedCode::fail(Code code, SourceSpan where, std::string sentence) {
  findings_->error(code, where, std::move(sentence));
  return kNoExpr;
}

std::string_view TypedCode::text_of(const Syntax& syntax) const {
  return findings_->source().text_of(syntax.span);
}

ExprId TypedCode::quantifier(Expr expr, ExprId where) {
  const unsigned self = 1U << static_cast<unsigned>(expr.level);
  const unsigned other = self << 1U;
  const SourceSpan span = expr.span;
  expr.levels = self;
  std::vector<ExprId> filters, joins;
  std::vector<ExprId> conditions;
  if (where != kNoExpr)
    conditions = at(where).op == Op::all_of ? at(where).args : std::vector<ExprId>{where};
  for (const ExprId id : conditions)
    ((at(id).levels & ~other) == 0 ? filters : joins).push_back(id);
  const auto conjunction = [&](std::vector<ExprId> ids) {
    if (ids.size() < 2) return ids.empty() ? kNoExpr : ids[0];
    return add({.op = Op::all_of, .type = Type::yes_no, .args = std::move(ids), .span = span});
  };
  expr.filter = conjunction(std::move(filters));
  expr.join = conjunction(std::move(joins));
  for (const ExprId id : {expr.filter, expr.join, expr.value}) {
    if (id == kNoExpr) continue;
    expr.levels |= at(id).levels & ~other;
    expr.height = std::max(expr.height, at(id).height + 1);
  }
  return add(std::move(expr));
}

ExprId TypedCode::add_of_feature(Expr expr) {
  expr.levels = 1U << static_cast<unsigned>(expr.level);
  return add(std::move(expr));
}

ExprId TypedCode::word(const std::string& text, SourceSpan span) {
  auto& words = pack_->words;
  const auto found = std::ranges::find(words, text);
  const auto number = static_cast<double>(found - words.begin());
  if (found == words.end()) words.push_back(text);
  return add({.op = Op::constant, .type = Type::text, .number = number, .span = span});
}

ExprId TypedCode::distance_along(SourceSpan span, int self, int other) {
  std::vector<ExprId> squares;
  for (const Attribute attribute : {Attribute::along, Attribute::base_height}) {
    std::vector<ExprId> ends;
    for (const int level : {self, other})
      ends.push_back(add_of_feature({.op = Op::attribute,
                                     .dimension = kLength,
                                     .index = static_cast<int>(column_of(attribute)),
                                     .level = level,
                                     .span = span}));
    const ExprId difference = add_operator(Op::subtract, kLength, std::move(ends), span);
    squares.push_back(add_operator(Op::multiply, kArea, {difference, difference}, span));
  }
  const ExprId sum = add_operator(Op::add, kArea, std::move(squares), span);
  return add_operator(Op::square_root, kLength, {sum}, span);
}

ExprId TypedCode::add_operator(Op op, Dimension dimension, std::vector<ExprId> operands,
                               SourceSpan span) {
  if (has_wrong(operands)) return kNoExpr;
  return add({.op = op, .dimension = dimension, .args = std::move(operands), .span = span});
}

ExprId TypedCode::negate(const Syntax& syntax, ExprId operand) {
  if (operand == kNoExpr) return kNoExpr;
  return add({.op = Op::negate,
              .dimension = at(operand).dimension,
              .args = {operand},
              .span = syntax.span});
}

ExprId TypedCode::logic(const Syntax& syntax, Op op, std::vector<ExprId> operands) {
  if (has_wrong(operands)) return kNoExpr;
  return add({.op = op, .type = Type::yes_no, .args = std::move(operands), .span = syntax.span});
}

ExprId TypedCode::call(const Syntax& syntax, std::vector<ExprId> operands) {
  Expr expr{.op = Op::absolute, .span = syntax.span};
  if (syntax.name == "min") expr.op = Op::minimum;
  if (syntax.name == "max") expr.op = Op::maximum;
  if (syntax.name == "sqrt") expr.op = Op::square_root;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    if (operands[i] == kNoExpr) return kNoExpr;
    if (i > 0 && !expect_same(syntax.children[0], operands[0], syntax.children[i], operands[i]))
      return kNoExpr;
  }
  expr.args = std::move(operands);
  expr.dimension = at(expr.args[0]).dimension;
  if (expr.op != Op::square_root) return add(std::move(expr));
  if (expr.dimension.metre % 2 != 0 || expr.dimension.degree % 2 != 0)
    return fail(Code::R230, syntax.span,
                fmt::format("the square root of {} has no unit", describe(expr.dimension)));
  expr.dimension = {expr.dimension.metre / 2, expr.dimension.degree / 2};
  return add(std::move(expr));
}

ExprId TypedCode::arithmetic(const Syntax& syntax, std::vector<ExprId> operands) {
  if (has_wrong(operands)) return kNoExpr;
  Expr expr{.op = op_of(syntax.symbol), .args = std::move(operands), .span = syntax.span};
  const Dimension p = at(expr.args[0]).dimension;
  const Dimension q = at(expr.args[1]).dimension;
  expr.dimension = expr.op == Op::multiply ? product(p, q)
                   : expr.op == Op::divide ? quotient(p, q)
                                           : p;
  const bool needs_same = expr.op == Op::add || expr.op == Op::subtract;
  if (needs_same &&
      !expect_same(syntax.children[0], expr.args[0], syntax.children[1], expr.args[1]))
    return kNoExpr;
  if (std::abs(expr.dimension.metre) > kHighestPower ||
      std::abs(expr.dimension.degree) > kHighestPower)
    return fail(Code::R230, syntax.span, "a unit to a power above 9 has no meaning here");
  return add(std::move(expr));
}

ExprId TypedCode::comparison(const Syntax& syntax, std::vector<ExprId> operands) {
  if (!expect_same(syntax.children[0], operands[0], syntax.children[1], operands[1]))
    return kNoExpr;
  return add({.op = op_of(syntax.symbol),
              .type = Type::yes_no,
              .args = std::move(operands),
              .span = syntax.span});
}

ExprId TypedCode::range(const Syntax& syntax, std::vector<ExprId> operands) {
  if (has_wrong(operands)) return kNoExpr;
  Expr expr{
      .op = Op::in_range, .type = Type::yes_no, .args = std::move(operands), .span = syntax.span};
  const Dimension wanted = at(expr.args[0]).dimension;
  const bool is_unit_missing = !wanted.is_plain() && is_bare_number(syntax.children[1]) &&
                               is_bare_number(syntax.children[2]);
  if (is_unit_missing)
    return fail(Code::R231, {syntax.children[1].span.begin, syntax.children[2].span.end},
                fmt::format("'{}' is {}: write {} {} .. {} {}", text_of(syntax.children[0]),
                            describe(wanted), text_of(syntax.children[1]), unit_of(wanted),
                            text_of(syntax.children[2]), unit_of(wanted)));
  for (const std::size_t bound : {1UL, 2UL})
    if (!expect_same(syntax.children[0], expr.args[0], syntax.children[bound], expr.args[bound]))
      return kNoExpr;
  const auto low = fold(*pack_, expr.args[1]);
  const auto high = fold(*pack_, expr.args[2]);
  if (low && high && *low > *high)
    return fail(Code::R212, {syntax.children[1].span.begin, syntax.children[2].span.end},
                "an empty range: its low end is above its high end");
  return add(std::move(expr));
}

ExprId TypedCode::similarity(const Syntax& syntax, std::vector<ExprId> operands) {
  if (has_wrong(operands)) return kNoExpr;
  Expr expr{
      .op = Op::similar, .type = Type::yes_no, .args = std::move(operands), .span = syntax.span};
  if (!expect_same(syntax.children[0], expr.args[0], syntax.children[1], expr.args[1]))
    return kNoExpr;
  const Dimension tolerance = at(expr.args[2]).dimension;
  if (!tolerance.is_plain())
    return fail(Code::R230, syntax.children[2].span,
                fmt::format("after 'by' comes a share such as 10 %, not {}; for a fixed distance "
                            "write abs(x - y) <= ...",
                            describe(tolerance)));
  return add(std::move(expr));
}

/// True if both are numbers of one dimension.
bool TypedCode::expect_same(const Syntax& left, ExprId left_id, const Syntax& right,
                            ExprId right_id) {
  if (left_id == kNoExpr || right_id == kNoExpr) return false;
  if (at(left_id).type != Type::number || at(right_id).type != Type::number) return false;
  const Dimension p = at(left_id).dimension;
  const Dimension q = at(right_id).dimension;
  if (p == q) return true;
  if (report_missing_unit(right, left, p) || report_missing_unit(left, right, q)) return false;
  if (report_param_without_unit(right, left, p) || report_param_without_unit(left, right, q))
    return false;
  fail(Code::R230, right.span,
       fmt::format("'{}' is {} and '{}' is {}", text_of(left), describe(p), text_of(right),
                   describe(q)));
  return false;
}

bool TypedCode::report_missing_unit(const Syntax& number, const Syntax& other, Dimension wanted) {
  if (!is_bare_number(number) || wanted.is_plain()) return false;
  fail(Code::R231, number.span,
       fmt::format("'{}' is {}: write {} {}", text_of(other), describe(wanted), text_of(number),
                   unit_of(wanted)));
  return true;
}

/// Of a param whose value is a bare number: the fault is there and not here. Said once.
bool TypedCode::report_param_without_unit(const Syntax& param, const Syntax& other,
                                          Dimension wanted) {
  if (param.kind != Syntax::Kind::parameter || wanted.is_plain()) return false;
  const int index = index_of(pack_->params, param.name);
  if (index < 0) return false;
  const SourceSpan where = pack_->params[static_cast<std::size_t>(index)].value_span;
  const std::string value(findings_->source().text_of(where));
  if (!is_without_unit(value)) return false;
  fail(Code::R231, where,
       fmt::format("'${}' is compared with '{}', {}, and has no unit: write {} {}", param.name,
                   text_of(other), describe(wanted), value, unit_of(wanted)));
  findings_->silence(where);
  return true;
}

}  // namespace oriel::rules
