#include "interpret/language/parser.h"

#include "interpret/language/findings.h"
#include "interpret/language/lexer.h"
#include "interpret/language/quantity.h"
#include "interpret/language/synonyms.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Ends the parse of one expression; what was wrong is among the findings.
struct ParseStop : std::exception {};

/// The tokens of one expression, eaten from the front.
class TokenStream {
 public:
  TokenStream(std::vector<Token> tokens, Findings& findings)
      : tokens_(std::move(tokens)), findings_(&findings) {}

  /// The token `ahead` of the next one; past the end the end token.
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] bool is_at_word(std::string_view word) const {
    return peek().kind == Token::Kind::word && peek().text == word;
  }

  Token take();
  bool take_if(Token::Kind kind);
  bool take_if_word(std::string_view word);
  /// The next token, which must be of that kind.
  Token expect(Token::Kind kind, const std::string& wanted);

  [[noreturn]] void fail(Code code, SourceSpan where, std::string sentence);
  /// R220: `wanted` was expected here.
  [[noreturn]] void fail_expecting(const std::string& wanted);

 private:
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Findings* findings_;
};

Token TokenStream::take() {
  const Token token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool TokenStream::take_if(Token::Kind kind) {
  if (peek().kind != kind) return false;
  take();
  return true;
}

bool TokenStream::take_if_word(std::string_view word) {
  if (!is_at_word(word)) return false;
  take();
  return true;
}

Token TokenStream::expect(Token::Kind kind, const std::string& wanted) {
  if (peek().kind != kind) fail_expecting(wanted);
  return take();
}

void TokenStream::fail(Code code, SourceSpan where, std::string sentence) {
  findings_->error(code, where, std::move(sentence));
  throw ParseStop();
}

/// Words of other languages, and what to write here; nothing for others.
std::string foreign_word(std::string_view word) {
  if (word == "AND" || word == "OR" || word == "NOT" || word == "IN" || word == "IS") {
    std::string small;
    for (const char c : word) small += static_cast<char>(c - 'A' + 'a');
    return "write '" + small + "'";
  }
  if (word == "between" || word == "BETWEEN" || word == "to")
    return "a range is written 'in lo .. hi', as in 'a in 1 m .. 2 m'";
  if (word == "like" || word == "LIKE") return "write '='";
  if (word == "then" || word == "if")
    return "conditions go under 'require', the label under 'label'";
  return "";
}

bool is_comparison(Token::Kind kind) {
  using enum Token::Kind;
  return kind == less || kind == less_equal || kind == greater || kind == greater_equal ||
         kind == equal || kind == not_equal;
}

void TokenStream::fail_expecting(const std::string& wanted) {
  const Token& found = peek();
  std::string advice;
  if (found.kind == Token::Kind::word) advice = foreign_word(found.text);
  if (is_comparison(found.kind))
    advice = "write the attribute again, as in 'a > 1 m and a < 2 m', or 'a in 1 m .. 2 m'";
  if (found.kind == Token::Kind::range && wanted != "an operator or the end")
    advice = "a range needs both ends, as in 'a in 1 m .. 2 m'";
  else if (found.kind == Token::Kind::range)
    advice = "a range is written with 'in', as in 'a in 1 m .. 2 m'";
  if (wanted.starts_with("'..'")) advice.clear();  // it shows a range itself
  const bool is_end = found.kind == Token::Kind::end;
  const auto decimals = [&] {
    return fmt::format("; decimals are written with a point: {}.{}", tokens_[at_ - 1].text,
                       peek(1).text);
  };
  const bool is_decimal_comma = found.kind == Token::Kind::comma && at_ > 0 &&
                                tokens_[at_ - 1].kind == Token::Kind::number &&
                                peek(1).kind == Token::Kind::number;
  fail(
      Code::R220, found.span,
      fmt::format("expected {}, found {}{}", wanted,
                  is_end ? "the end" : fmt::format("'{}'", findings_->source().text_of(found.span)),
                  is_decimal_comma ? decimals()
                  : advice.empty() ? ""
                                   : "; " + advice));
}

const std::vector<std::string>& quantifiers() {
  static const std::vector<std::string> words = {"exists", "none", "count", "all"};
  return words;
}

const std::vector<std::string>& functions() {
  static const std::vector<std::string> words = {"abs", "min", "max", "mean", "sqrt"};
  return words;
}

/// What is called with one fixed word, which says which feature it speaks of. They are words of the
/// language only where a bracket follows.
struct FixedCall {
  const char* name;
  const char* argument;
  Syntax::Kind kind;
};
constexpr FixedCall kFixedCalls[] = {{"distance_along", "other", Syntax::Kind::distance},
                                     {"gap", "members", Syntax::Kind::group_gap}};

const FixedCall* fixed_call_of(std::string_view word) {
  const auto* found = std::ranges::find(kFixedCalls, word, &FixedCall::name);
  return found == std::end(kFixedCalls) ? nullptr : found;
}

std::vector<std::string> callables() {
  std::vector<std::string> words = functions();
  words.insert(words.end(), quantifiers().begin(), quantifiers().end());
  return words;
}

bool is_reserved(std::string_view word) { return contains(reserved_words(), word); }

}  // namespace

const std::vector<std::string>& reserved_words() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> list = {"and",   "or",   "not",   "in",   "is", "by",
                                     "where", "self", "other", "host", "of"};
    for (const std::string& word : callables()) list.push_back(word);
    return list;
  }();
  return words;
}

namespace {

/// How tightly operators bind, loosest first. `not` stands between `and` and the comparisons.
enum class Power { loosest, disjunction, conjunction, comparison, sum, product };

/// A Pratt parser: an operand, then operators as long as they bind tighter than what waits.
/// Errors end it with ParseStop.
class ExpressionParser {
 public:
  ExpressionParser(std::vector<Token> tokens, Findings& findings)
      : tokens_(std::move(tokens), findings) {}

  /// An expression of operators that bind tighter than `least`.
  Syntax expression(Power least);
  /// `lo .. hi`.
  RangeSyntax range();
  void expect_end();

 private:
  using Kind = Syntax::Kind;

  /// `node` with its children in place, its span drawn over them and its height counted.
  Syntax finish(Syntax node, std::vector<Syntax> children);
  void check_depth(int depth, SourceSpan where);

  // Operands.
  Syntax operand();
  Syntax number();
  [[noreturn]] void fail_at_unit(const Token& word);
  Syntax parameter();
  Syntax negation();
  Syntax negative();
  Syntax in_brackets();
  Syntax word();
  Syntax scoped(Syntax::Scope scope, SourceSpan begin);
  Syntax is_test(Syntax::Scope scope, bool is_of_host, SourceSpan begin);
  Syntax plain_name(Syntax::Scope scope, SourceSpan begin);
  Syntax call();
  Syntax fixed_call();
  Syntax quantifier();
  Syntax aggregate(Syntax node, Syntax value);
  void relation_of(Syntax& node, std::vector<Syntax>& children);

  // Operators.
  Syntax infix(Syntax left, Power power);
  Syntax logical(Syntax left, Kind kind, Power power);
  Syntax membership(Syntax left);
  Syntax similarity(Syntax left);
  Syntax binary(Syntax left, Power power);

  TokenStream tokens_;
  int depth_ = 0;
};

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

void ExpressionParser::check_depth(int depth, SourceSpan where) {
  if (depth > kDeepestExpression)
    tokens_.fail(Code::R222, where, "an expression nests no deeper than 64 levels");
}

Syntax ExpressionParser::finish(Syntax node, std::vector<Syntax> children) {
  for (const Syntax& child : children) {
    node.span.begin = std::min(node.span.begin, child.span.begin);
    node.span.end = std::max(node.span.end, child.span.end);
    node.height = std::max(node.height, child.height + 1);
  }
  check_depth(node.height, node.name_span);
  node.children = std::move(children);
  return node;
}

Syntax ExpressionParser::expression(Power least) {
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

RangeSyntax ExpressionParser::range() {
  Syntax low = expression(Power::comparison);
  const bool has_dash = low.kind == Kind::binary && low.symbol == Token::Kind::minus &&
                        tokens_.peek().kind != Token::Kind::range;
  if (has_dash)
    tokens_.fail(Code::R220, low.name_span,
                 "'-' subtracts; a range is written with two points: 0.3 m .. 2.2 m");
  tokens_.expect(Token::Kind::range, "'..' as in 0.3 m .. 2.2 m");
  return {std::move(low), expression(Power::comparison)};
}

void ExpressionParser::expect_end() {
  if (tokens_.peek().kind != Token::Kind::end) tokens_.fail_expecting("an operator or the end");
}

Syntax ExpressionParser::infix(Syntax left, Power power) {
  if (power == Power::disjunction) return logical(std::move(left), Kind::any_of, power);
  if (power == Power::conjunction) return logical(std::move(left), Kind::all_of, power);
  if (tokens_.is_at_word("in")) return membership(std::move(left));
  if (tokens_.peek().kind == Token::Kind::tilde) return similarity(std::move(left));
  return binary(std::move(left), power);
}

/// `a and b and c` is one node with three children.
Syntax ExpressionParser::logical(Syntax left, Kind kind, Power power) {
  Syntax node{.kind = kind, .span = left.span, .name_span = tokens_.peek().span};
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  while (power_of(tokens_.peek()) == power) {
    tokens_.take();
    children.push_back(expression(power));
  }
  return finish(std::move(node), std::move(children));
}

Syntax ExpressionParser::membership(Syntax left) {
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

Syntax ExpressionParser::similarity(Syntax left) {
  Syntax node{.kind = Kind::similarity, .span = left.span, .name_span = tokens_.take().span};
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  children.push_back(expression(Power::comparison));
  if (!tokens_.take_if_word("by")) tokens_.fail_expecting("'by' as in a ~ other.a by 10 %");
  children.push_back(expression(Power::comparison));
  return finish(std::move(node), std::move(children));
}

Syntax ExpressionParser::binary(Syntax left, Power power) {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::binary, .span = left.span, .name_span = token.span};
  node.symbol = token.kind;
  std::vector<Syntax> children;
  children.push_back(std::move(left));
  children.push_back(expression(power));
  return finish(std::move(node), std::move(children));
}

Syntax ExpressionParser::operand() {
  switch (tokens_.peek().kind) {
    case Token::Kind::number:
      return number();
    case Token::Kind::parameter:
      return parameter();
    case Token::Kind::minus:
      return negative();
    case Token::Kind::open_round:
      return in_brackets();
    case Token::Kind::word:
      return tokens_.is_at_word("not") ? negation() : word();
    default:
      tokens_.fail_expecting("a value or a condition");
  }
}

Syntax ExpressionParser::parameter() {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::parameter, .span = token.span, .name_span = token.span};
  node.name = token.text;
  return node;
}

Syntax ExpressionParser::number() {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::number, .span = token.span, .name_span = token.span};
  node.number = token.number;
  const Token& unit = tokens_.peek();
  const bool is_symbol = unit.kind == Token::Kind::percent || unit.kind == Token::Kind::map_unit;
  const bool is_unit_word = unit.kind == Token::Kind::word && !is_reserved(unit.text);
  if (!is_symbol && !is_unit_word) return node;
  if (is_unit_word && !unit_word(unit.text)) fail_at_unit(unit);
  node.name = unit.text;
  node.span.end = unit.span.end;
  tokens_.take();
  return node;
}

/// What follows a number is neither a unit nor a word of the language.
void ExpressionParser::fail_at_unit(const Token& word) {
  const std::string meant = foreign_word(word.text);
  if (!meant.empty())
    tokens_.fail(Code::R220, word.span, fmt::format("'{}': {}", word.text, meant));
  tokens_.fail(Code::R233, word.span,
               unknown_name(NameKind::unit, "unit", word.text, unit_names(),
                            "; the units are: " + join(unit_names())));
}

Syntax ExpressionParser::negation() {
  const SourceSpan symbol = tokens_.take().span;
  Syntax node{.kind = Kind::negation, .span = symbol, .name_span = symbol};
  std::vector<Syntax> children;
  children.push_back(expression(Power::conjunction));
  return finish(std::move(node), std::move(children));
}

Syntax ExpressionParser::negative() {
  const SourceSpan symbol = tokens_.take().span;
  Syntax node{.kind = Kind::negate, .span = symbol, .name_span = symbol};
  std::vector<Syntax> children;
  children.push_back(expression(Power::product));
  return finish(std::move(node), std::move(children));
}

Syntax ExpressionParser::in_brackets() {
  const SourceSpan open = tokens_.take().span;
  Syntax inner = expression(Power::loosest);
  const SourceSpan close = tokens_.expect(Token::Kind::close_round, "')'").span;
  inner.span = {open.begin, close.end};
  return inner;
}

Syntax ExpressionParser::word() {
  const Token token = tokens_.peek();
  if (contains(quantifiers(), token.text)) return quantifier();
  if (contains(functions(), token.text)) return call();
  const bool is_called = tokens_.peek(1).kind == Token::Kind::open_round;
  if (is_called && fixed_call_of(token.text) != nullptr) return fixed_call();
  if (is_called && !is_reserved(token.text)) {
    auto known = callables();
    for (const FixedCall& called : kFixedCalls) known.emplace_back(called.name);
    tokens_.fail(Code::R220, token.span,
                 unknown_name(NameKind::function, "function", token.text, known,
                              "; the functions are: " + join(known)));
  }
  if (tokens_.take_if_word("self")) return scoped(Syntax::Scope::self, token.span);
  if (tokens_.take_if_word("other")) return scoped(Syntax::Scope::other, token.span);
  if (tokens_.take_if_word("host")) return is_test(Syntax::Scope::here, true, token.span);
  if (tokens_.is_at_word("is")) return is_test(Syntax::Scope::here, false, token.span);
  return plain_name(Syntax::Scope::here, token.span);
}

Syntax ExpressionParser::scoped(Syntax::Scope scope, SourceSpan begin) {
  if (tokens_.is_at_word("is")) return is_test(scope, false, begin);
  tokens_.expect(Token::Kind::dot, "'is' or '.'");
  if (tokens_.take_if_word("host")) return is_test(scope, true, begin);
  return plain_name(scope, begin);
}

Syntax ExpressionParser::is_test(Syntax::Scope scope, bool is_of_host, SourceSpan begin) {
  if (!tokens_.take_if_word("is")) tokens_.fail_expecting("'is' and a class, as in 'host is wall'");
  if (tokens_.is_at_word("not"))
    tokens_.fail(Code::R220, tokens_.peek().span,
                 "'is not': write 'not' in front, as in 'not self is window'");
  if (tokens_.peek().kind != Token::Kind::word || is_reserved(tokens_.peek().text))
    tokens_.fail_expecting("a class");
  const Token name = tokens_.take();
  Syntax node{.kind = Kind::is_test, .span = {begin.begin, name.span.end}, .name_span = name.span};
  node.name = name.text;
  node.scope = scope;
  node.is_of_host = is_of_host;
  return node;
}

Syntax ExpressionParser::plain_name(Syntax::Scope scope, SourceSpan begin) {
  if (tokens_.peek().kind != Token::Kind::word || is_reserved(tokens_.peek().text))
    tokens_.fail_expecting(scope == Syntax::Scope::here ? "a value or a condition"
                                                        : "an attribute");
  const Token token = tokens_.take();
  if (tokens_.is_at_word("is"))
    tokens_.fail(Code::R220, token.span,
                 "'is' asks for a class: write 'self is', 'host is' or 'is' alone before it");
  Syntax node{.kind = Kind::name, .span = {begin.begin, token.span.end}, .name_span = token.span};
  node.name = token.text;
  node.scope = scope;
  return node;
}

Syntax ExpressionParser::call() {
  const Token name = tokens_.take();
  Syntax node{.kind = Kind::call, .span = name.span, .name_span = name.span};
  node.name = name.text;
  tokens_.expect(Token::Kind::open_round, fmt::format("'(' after '{}'", name.text));
  std::vector<Syntax> arguments;
  arguments.push_back(expression(Power::loosest));
  const bool is_unary = node.name == "abs" || node.name == "sqrt";
  if (!is_unary && tokens_.is_at_word("of"))
    return aggregate(std::move(node), std::move(arguments[0]));
  if (node.name == "mean") tokens_.fail_expecting("'of' and a relation, as in mean(a of alike)");
  while (tokens_.take_if(Token::Kind::comma)) arguments.push_back(expression(Power::loosest));
  node.span.end = tokens_.expect(Token::Kind::close_round, "',' or ')'").span.end;
  if (is_unary ? arguments.size() != 1 : arguments.size() < 2)
    tokens_.fail(
        Code::R220, name.span,
        fmt::format("'{}' takes {}", name.text, is_unary ? "one value" : "two values or more"));
  return finish(std::move(node), std::move(arguments));
}

/// `distance_along(other)`, `gap(members)`.
Syntax ExpressionParser::fixed_call() {
  const Token name = tokens_.take();
  const FixedCall& called = *fixed_call_of(name.text);
  Syntax node{.kind = called.kind, .span = name.span, .name_span = name.span};
  tokens_.expect(Token::Kind::open_round, "'('");
  if (!tokens_.take_if_word(called.argument))
    tokens_.fail_expecting(
        fmt::format("'{}': it is {}({})", called.argument, called.name, called.argument));
  node.span.end = tokens_.expect(Token::Kind::close_round, "')'").span.end;
  return node;
}

Syntax ExpressionParser::quantifier() {
  const Token name = tokens_.take();
  Syntax node{.kind = Kind::quantifier, .span = name.span, .name_span = name.span};
  node.name = name.text;
  tokens_.expect(Token::Kind::open_round, fmt::format("'(' after '{}'", name.text));
  std::vector<Syntax> condition;
  relation_of(node, condition);
  return finish(std::move(node), std::move(condition));
}

/// `min(value of relation where condition)`, from `of` on.
Syntax ExpressionParser::aggregate(Syntax node, Syntax value) {
  tokens_.take();
  node.kind = Kind::aggregate;
  std::vector<Syntax> children;
  children.push_back(std::move(value));
  relation_of(node, children);
  return finish(std::move(node), std::move(children));
}

/// `relation where condition)`; the condition is added to `children`.
void ExpressionParser::relation_of(Syntax& node, std::vector<Syntax>& children) {
  const Token relation = tokens_.expect(Token::Kind::word, "a relation");
  node.relation = relation.text;
  node.relation_span = relation.span;
  const bool has_condition = tokens_.take_if_word("where");
  if (has_condition) children.push_back(expression(Power::loosest));
  const char* wanted = has_condition ? "')'" : "'where' or ')'";
  node.span.end = tokens_.expect(Token::Kind::close_round, wanted).span.end;
}

/// What `parse` makes of the expression at `where`, or nothing and an error.
template <class Result>
std::optional<Result> parse_at(SourceSpan where, Findings& findings,
                               Result (*parse)(ExpressionParser&)) {
  if (where.end - where.begin > kLongestExpression) {
    findings.error(Code::R222, {where.begin, where.begin},
                   "an expression is no longer than 1000 characters; use macros");
    return std::nullopt;
  }
  auto tokens = tokenise(where, findings);
  if (!tokens) return std::nullopt;
  ExpressionParser parser(std::move(*tokens), findings);
  try {
    Result result = parse(parser);
    parser.expect_end();
    return result;
  } catch (const ParseStop&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Syntax> parse_expression(SourceSpan where, Findings& findings) {
  return parse_at<Syntax>(
      where, findings, [](ExpressionParser& parser) { return parser.expression(Power::loosest); });
}

std::optional<RangeSyntax> parse_range(SourceSpan where, Findings& findings) {
  return parse_at<RangeSyntax>(where, findings,
                               [](ExpressionParser& parser) { return parser.range(); });
}

}  // namespace oriel::rules
