#include "interpret/compile/checker.h"
#include "interpret/compile/fold.h"
#include "interpret/language/quantity.h"
#include "interpret/language/suggest.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Dimensions beyond this power have no use and would make messages absurd.
constexpr int kHighestPower = 9;

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

bool is_arithmetic(Op op) {
  return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide;
}

}  // namespace

bool is_bare_number(const Syntax& syntax) {
  if (syntax.kind == Syntax::Kind::negate) return is_bare_number(syntax.children[0]);
  return syntax.kind == Syntax::Kind::number && syntax.name.empty();
}

ExprId Checker::check_as_number(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || at(id).type == Type::number) return id;
  return fail(
      "R232", syntax.span,
      fmt::format("'{}' is {}; a number is needed here", text_of(syntax), describe(at(id))));
}

ExprId Checker::check_as_condition(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || at(id).type == Type::yes_no) return id;
  return fail(
      "R232", syntax.span,
      fmt::format("'{}' is {}; a condition is needed here", text_of(syntax), describe(at(id))));
}

ExprId Checker::check_negate(const Syntax& syntax) {
  const ExprId id = check_as_number(syntax.children[0]);
  if (id == kNoExpr) return kNoExpr;
  return add({.op = Op::negate, .dimension = at(id).dimension, .args = {id}, .span = syntax.span});
}

ExprId Checker::check_logic(const Syntax& syntax, Op op) {
  Expr expr{.op = op, .type = Type::yes_no, .span = syntax.span};
  bool is_good = true;
  for (const Syntax& child : syntax.children) {
    expr.args.push_back(check_as_condition(child));
    is_good = is_good && expr.args.back() != kNoExpr;
  }
  return is_good ? add(std::move(expr)) : kNoExpr;
}

ExprId Checker::check_call(const Syntax& syntax) {
  Expr expr{.op = Op::absolute, .span = syntax.span};
  if (syntax.name == "min") expr.op = Op::minimum;
  if (syntax.name == "max") expr.op = Op::maximum;
  if (syntax.name == "sqrt") expr.op = Op::square_root;
  bool is_good = true;
  for (const Syntax& child : syntax.children) {
    const ExprId id = check_as_number(child);
    is_good = is_good && id != kNoExpr;
    if (is_good && !expr.args.empty())
      is_good = expect_same(syntax.children[0], expr.args[0], child, id);
    expr.args.push_back(id);
  }
  if (!is_good) return kNoExpr;
  expr.dimension = at(expr.args[0]).dimension;
  if (expr.op != Op::square_root) return add(std::move(expr));
  if (expr.dimension.metre % 2 != 0 || expr.dimension.degree % 2 != 0)
    return fail("R230", syntax.span,
                fmt::format("the square root of {} has no unit", describe(expr.dimension)));
  expr.dimension = {expr.dimension.metre / 2, expr.dimension.degree / 2};
  return add(std::move(expr));
}

ExprId Checker::check_binary(const Syntax& syntax) {
  return is_arithmetic(op_of(syntax.symbol)) ? check_arithmetic(syntax) : check_comparison(syntax);
}

ExprId Checker::check_arithmetic(const Syntax& syntax) {
  const Syntax& left = syntax.children[0];
  const Syntax& right = syntax.children[1];
  Expr expr{.op = op_of(syntax.symbol), .span = syntax.span};
  expr.args = {check_as_number(left), check_as_number(right)};
  if (expr.args[0] == kNoExpr || expr.args[1] == kNoExpr) return kNoExpr;
  const Dimension p = at(expr.args[0]).dimension;
  const Dimension q = at(expr.args[1]).dimension;
  expr.dimension = expr.op == Op::multiply ? product(p, q)
                   : expr.op == Op::divide ? quotient(p, q)
                                           : p;
  const bool needs_same = expr.op == Op::add || expr.op == Op::subtract;
  if (needs_same && !expect_same(left, expr.args[0], right, expr.args[1])) return kNoExpr;
  if (std::abs(expr.dimension.metre) > kHighestPower ||
      std::abs(expr.dimension.degree) > kHighestPower)
    return fail("R230", syntax.span, "a unit to a power above 9 has no meaning here");
  return add(std::move(expr));
}

ExprId Checker::check_comparison(const Syntax& syntax) {
  const Syntax& left = syntax.children[0];
  const Syntax& right = syntax.children[1];
  Expr expr{.op = op_of(syntax.symbol), .type = Type::yes_no, .span = syntax.span};
  const ExprId first = check(left);
  if (first != kNoExpr && at(first).type == Type::text) {
    if (expr.op != Op::equal && expr.op != Op::not_equal)
      return fail(
          "R232", syntax.name_span,
          fmt::format("'{}' is a text; texts are compared with =, != and in [..]", text_of(left)));
    expr.args = {first, check_word(right, first)};
    return expr.args[1] == kNoExpr ? kNoExpr : add(std::move(expr));
  }
  if (first != kNoExpr && at(first).type == Type::yes_no)
    return fail(
        "R232", left.span,
        fmt::format("'{}' is yes or no already; write it alone, or 'not' in front", text_of(left)));
  expr.args = {first, check_as_number(right)};
  if (first == kNoExpr || expr.args[1] == kNoExpr) return kNoExpr;
  if (!expect_same(left, expr.args[0], right, expr.args[1])) return kNoExpr;
  return add(std::move(expr));
}

ExprId Checker::check_range(const Syntax& syntax) {
  Expr expr{.op = Op::in_range, .type = Type::yes_no, .span = syntax.span};
  for (const Syntax& child : syntax.children) expr.args.push_back(check_as_number(child));
  if (std::ranges::find(expr.args, kNoExpr) != expr.args.end()) return kNoExpr;
  for (const std::size_t bound : {1UL, 2UL})
    if (!expect_same(syntax.children[0], expr.args[0], syntax.children[bound], expr.args[bound]))
      return kNoExpr;
  const auto low = fold(*pack_, expr.args[1]);
  const auto high = fold(*pack_, expr.args[2]);
  if (low && high && *low > *high)
    return fail("R212", {syntax.children[1].span.begin, syntax.children[2].span.end},
                "an empty range: its low end is above its high end");
  return add(std::move(expr));
}

ExprId Checker::check_list(const Syntax& syntax) {
  Expr expr{.op = Op::in_list, .type = Type::yes_no, .span = syntax.span};
  const Syntax& value = syntax.children[0];
  expr.args.push_back(check(value));
  if (expr.args[0] == kNoExpr) return kNoExpr;
  const Type type = at(expr.args[0]).type;
  if (type == Type::yes_no)
    return fail(
        "R232", value.span,
        fmt::format("'{}' is yes or no; write it alone, or 'not' in front", text_of(value)));
  bool is_good = true;
  for (std::size_t i = 1; i < syntax.children.size(); ++i) {
    const Syntax& member = syntax.children[i];
    const ExprId id =
        type == Type::text ? check_word(member, expr.args[0]) : check_as_number(member);
    is_good = is_good && id != kNoExpr &&
              (type == Type::text || expect_same(value, expr.args[0], member, id));
    expr.args.push_back(id);
  }
  return is_good ? add(std::move(expr)) : kNoExpr;
}

ExprId Checker::check_similarity(const Syntax& syntax) {
  Expr expr{.op = Op::similar, .type = Type::yes_no, .span = syntax.span};
  for (const Syntax& child : syntax.children) expr.args.push_back(check_as_number(child));
  if (std::ranges::find(expr.args, kNoExpr) != expr.args.end()) return kNoExpr;
  if (!expect_same(syntax.children[0], expr.args[0], syntax.children[1], expr.args[1]))
    return kNoExpr;
  const Dimension tolerance = at(expr.args[2]).dimension;
  if (!tolerance.is_plain())
    return fail("R230", syntax.children[2].span,
                fmt::format("after 'by' stands a share such as 10 %, not {}; for a fixed distance "
                            "write abs(x - y) <= ...",
                            describe(tolerance)));
  return add(std::move(expr));
}

/// The right side of a text: a word, or another text by its full name.
ExprId Checker::check_word(const Syntax& syntax, ExprId text) {
  const bool is_bare = syntax.kind == Syntax::Kind::name && syntax.scope == Syntax::Scope::here;
  if (!is_bare) {
    const ExprId id = check(syntax);
    if (id == kNoExpr || at(id).type == Type::text) return id;
    return fail(
        "R232", syntax.span,
        fmt::format("'{}' is {}; a word is needed here", text_of(syntax), describe(at(id))));
  }
  const auto column = static_cast<std::size_t>(at(text).index);
  const auto words = words_for(column);
  if (!words.empty() && std::ranges::find(words, syntax.name) == words.end()) {
    std::string advice = did_you_mean(syntax.name, words);
    if (advice.empty()) advice = fmt::format(" (it is one of {})", join(words));
    return fail("R234", syntax.span,
                fmt::format("'{}' is never '{}'{}", schema()[column].name, syntax.name, advice));
  }
  Expr expr{.op = Op::constant, .type = Type::text, .span = syntax.span};
  expr.number = word_number(syntax.name);
  return add(std::move(expr));
}

/// True if both are numbers of one dimension.
bool Checker::expect_same(const Syntax& left, ExprId left_id, const Syntax& right,
                          ExprId right_id) {
  if (left_id == kNoExpr || right_id == kNoExpr) return false;
  if (at(left_id).type != Type::number || at(right_id).type != Type::number) return false;
  const Dimension p = at(left_id).dimension;
  const Dimension q = at(right_id).dimension;
  if (p == q) return true;
  if (report_missing_unit(right, left, p) || report_missing_unit(left, right, q)) return false;
  fail("R230", right.span,
       fmt::format("'{}' is {} and '{}' is {}", text_of(left), describe(p), text_of(right),
                   describe(q)));
  return false;
}

bool Checker::report_missing_unit(const Syntax& number, const Syntax& other, Dimension wanted) {
  if (!is_bare_number(number) || wanted.is_plain()) return false;
  fail("R231", number.span,
       fmt::format("'{}' is {}: write {} {}", text_of(other), describe(wanted), text_of(number),
                   unit_of(wanted)));
  return true;
}

}  // namespace oriel::rules
