#include "interpret/language/pratt.h"

#include "interpret/language/parser.h"

#include <algorithm>

namespace oriel::rules {

namespace {

Power power_of(const Token& token) {
  switch (token.kind) {
    case Token::Kind::plus:
    case Token::Kind::minus:
      return Power::sum;
    case Token::Kind::star:
    case Token::Kind::slash:
      return Power::product;
    case Token::Kind::less:
    case Token::Kind::less_equal:
    case Token::Kind::greater:
    case Token::Kind::greater_equal:
    case Token::Kind::equal:
    case Token::Kind::not_equal:
    case Token::Kind::tilde:
      return Power::comparison;
    case Token::Kind::word:
      if (token.text == "or") return Power::disjunction;
      if (token.text == "and") return Power::conjunction;
      return token.text == "in" ? Power::comparison : Power::loosest;
    default:
      return Power::loosest;
  }
}

}  // namespace

void Pratt::check_depth(int depth, Span where) {
  if (depth > kDeepestExpression)
    tokens_.fail(Code::R222, where, "an expression nests no deeper than 64 levels");
}

Syntax Pratt::finish(Syntax node, std::vector<Syntax> children) {
  for (const Syntax& child : children) {
    node.span.begin = std::min(node.span.begin, child.span.begin);
    node.span.end = std::max(node.span.end, child.span.end);
    node.height = std::max(node.height, child.height + 1);
  }
  check_depth(node.height, node.name_span);
  node.children = std::move(children);
  return node;
}

Syntax Pratt::expression(Power least) {
  check_depth(++depth_, tokens_.peek().span);
  Syntax left = operand();
  for (Power power = power_of(tokens_.peek()); power > least; power = power_of(tokens_.peek())) {
    left = infix(std::move(left), power);
    const bool is_chain =
        power == Power::comparison && power_of(tokens_.peek()) == Power::comparison;
    if (is_chain)
      tokens_.fail(Code::R220, tokens_.peek().span,
                   "comparisons are not chained; write 'x in lo .. hi' or use 'and'");
  }
  --depth_;
  return left;
}

RangeSyntax Pratt::range() {
  Syntax low = expression(Power::comparison);
  tokens_.expect(Token::Kind::range, "'..' as in 0.3 m .. 2.2 m");
  return {std::move(low), expression(Power::comparison)};
}

void Pratt::expect_end() {
  if (tokens_.peek().kind != Token::Kind::end) tokens_.fail_expecting("an operator or the end");
}

Syntax Pratt::infix(Syntax left, Power power) {
  if (power == Power::disjunction) return logical(std::move(left), Kind::any_of, power);
  if (power == Power::conjunction) return logical(std::move(left), Kind::all_of, power);
  if (tokens_.is_at_word("in")) return membership(std::move(left));
  if (tokens_.peek().kind == Token::Kind::tilde) return similarity(std::move(left));
  return binary(std::move(left), power);
}

/// `a and b and c` is one node with three children.
Syntax Pratt::logical(Syntax left, Kind kind, Power power) {
  Syntax node{.kind = kind, .span = left.span, .name_span = tokens_.peek().span};
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  while (power_of(tokens_.peek()) == power) {
    tokens_.take();
    children.push_back(expression(power));
  }
  return finish(std::move(node), std::move(children));
}

Syntax Pratt::membership(Syntax left) {
  Syntax node{.kind = Kind::range_test, .span = left.span, .name_span = tokens_.take().span};
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  if (!tokens_.take_if(Token::Kind::open_square)) {
    RangeSyntax bounds = range();
    children.push_back(std::move(bounds.low));
    children.push_back(std::move(bounds.high));
    return finish(std::move(node), std::move(children));
  }
  node.kind = Kind::list_test;
  children.push_back(expression(Power::comparison));
  while (tokens_.take_if(Token::Kind::comma)) children.push_back(expression(Power::comparison));
  node.span.end = tokens_.expect(Token::Kind::close_square, "',' or ']'").span.end;
  return finish(std::move(node), std::move(children));
}

Syntax Pratt::similarity(Syntax left) {
  Syntax node{.kind = Kind::similarity, .span = left.span, .name_span = tokens_.take().span};
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  children.push_back(expression(Power::comparison));
  if (!tokens_.take_if_word("by")) tokens_.fail_expecting("'by' as in a ~ other.a by 10 %");
  children.push_back(expression(Power::comparison));
  return finish(std::move(node), std::move(children));
}

Syntax Pratt::binary(Syntax left, Power power) {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::binary, .span = left.span, .name_span = token.span};
  node.symbol = token.kind;
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  children.push_back(expression(power));
  return finish(std::move(node), std::move(children));
}

}  // namespace oriel::rules
