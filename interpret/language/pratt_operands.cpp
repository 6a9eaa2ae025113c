#include "interpret/language/parser.h"
#include "interpret/language/pratt.h"
#include "interpret/language/quantity.h"
#include "interpret/language/suggest.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

const std::vector<std::string>& quantifiers() {
  static const std::vector<std::string> words = {"exists", "none", "count", "all"};
  return words;
}

const std::vector<std::string>& functions() {
  static const std::vector<std::string> words = {"abs", "min", "max", "mean", "sqrt"};
  return words;
}

/// What is called with one fixed word, which says of whom it speaks. They are words of the language
/// only where a bracket follows.
struct Measure {
  const char* name;
  const char* argument;
  Syntax::Kind kind;
};
constexpr Measure kMeasures[] = {{"distance_along", "other", Syntax::Kind::distance},
                                 {"gap", "members", Syntax::Kind::group_gap}};

const Measure* measure_of(std::string_view word) {
  const auto* found = std::ranges::find(kMeasures, word, &Measure::name);
  return found == std::end(kMeasures) ? nullptr : found;
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

Syntax Pratt::operand() {
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

Syntax Pratt::parameter() {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::parameter, .span = token.span, .name_span = token.span};
  node.name = token.text;
  return node;
}

Syntax Pratt::number() {
  const Token token = tokens_.take();
  Syntax node{.kind = Kind::number, .span = token.span, .name_span = token.span};
  node.number = token.number;
  const Token& unit = tokens_.peek();
  const bool is_symbol = unit.kind == Token::Kind::percent || unit.kind == Token::Kind::map_unit;
  const bool is_unit_word = unit.kind == Token::Kind::word && !is_reserved(unit.text);
  if (!is_symbol && !is_unit_word) return node;
  if (is_unit_word && !unit_word(unit.text))
    tokens_.fail(Code::R233, unit.span,
                 fmt::format("unknown unit '{}'{} (units: {})", unit.text,
                             did_you_mean(unit.text, unit_names()), join(unit_names())));
  node.name = unit.text;
  node.span.end = unit.span.end;
  tokens_.take();
  return node;
}

Syntax Pratt::negation() {
  const Span symbol = tokens_.take().span;
  Syntax node{.kind = Kind::negation, .span = symbol, .name_span = symbol};
  std::vector<Syntax> children;
  children.push_back(expression(Power::conjunction));
  return finish(std::move(node), std::move(children));
}

Syntax Pratt::negative() {
  const Span symbol = tokens_.take().span;
  Syntax node{.kind = Kind::negate, .span = symbol, .name_span = symbol};
  std::vector<Syntax> children;
  children.push_back(expression(Power::product));
  return finish(std::move(node), std::move(children));
}

Syntax Pratt::in_brackets() {
  const Span open = tokens_.take().span;
  Syntax inner = expression(Power::loosest);
  const Span close = tokens_.expect(Token::Kind::close_round, "')'").span;
  inner.span = {open.begin, close.end};
  return inner;
}

Syntax Pratt::word() {
  const Token token = tokens_.peek();
  if (contains(quantifiers(), token.text)) return quantifier();
  if (contains(functions(), token.text)) return call();
  const bool is_called = tokens_.peek(1).kind == Token::Kind::open_round;
  if (is_called && measure_of(token.text) != nullptr) return measure();
  if (is_called && !is_reserved(token.text)) {
    auto known = callables();
    for (const Measure& measure : kMeasures) known.emplace_back(measure.name);
    tokens_.fail(
        Code::R220, token.span,
        fmt::format("unknown function '{}'{}", token.text, did_you_mean(token.text, known)));
  }
  if (tokens_.take_if_word("self")) return scoped(Syntax::Scope::self, token.span);
  if (tokens_.take_if_word("other")) return scoped(Syntax::Scope::other, token.span);
  if (tokens_.take_if_word("host")) return is_test(Syntax::Scope::here, true, token.span);
  if (tokens_.is_at_word("is")) return is_test(Syntax::Scope::here, false, token.span);
  return plain_name(Syntax::Scope::here, token.span);
}

Syntax Pratt::scoped(Syntax::Scope scope, Span begin) {
  if (tokens_.is_at_word("is")) return is_test(scope, false, begin);
  tokens_.expect(Token::Kind::dot, "'is' or '.'");
  if (tokens_.take_if_word("host")) return is_test(scope, true, begin);
  return plain_name(scope, begin);
}

Syntax Pratt::is_test(Syntax::Scope scope, bool is_of_host, Span begin) {
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

Syntax Pratt::plain_name(Syntax::Scope scope, Span begin) {
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

Syntax Pratt::call() {
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
Syntax Pratt::measure() {
  const Token name = tokens_.take();
  const Measure& measure = *measure_of(name.text);
  Syntax node{.kind = measure.kind, .span = name.span, .name_span = name.span};
  tokens_.expect(Token::Kind::open_round, "'('");
  if (!tokens_.take_if_word(measure.argument))
    tokens_.fail_expecting(
        fmt::format("'{}': it is {}({})", measure.argument, measure.name, measure.argument));
  node.span.end = tokens_.expect(Token::Kind::close_round, "')'").span.end;
  return node;
}

Syntax Pratt::quantifier() {
  const Token name = tokens_.take();
  Syntax node{.kind = Kind::quantifier, .span = name.span, .name_span = name.span};
  node.name = name.text;
  tokens_.expect(Token::Kind::open_round, fmt::format("'(' after '{}'", name.text));
  std::vector<Syntax> condition;
  relation_of(node, condition);
  return finish(std::move(node), std::move(condition));
}

/// `min(value of relation where condition)`, from `of` on.
Syntax Pratt::aggregate(Syntax node, Syntax value) {
  tokens_.take();
  node.kind = Kind::aggregate;
  std::vector<Syntax> children;
  children.push_back(std::move(value));
  relation_of(node, children);
  return finish(std::move(node), std::move(children));
}

/// `relation where condition)`; the condition is added to `children`.
void Pratt::relation_of(Syntax& node, std::vector<Syntax>& children) {
  const Token relation = tokens_.expect(Token::Kind::word, "a relation");
  node.relation = relation.text;
  node.relation_span = relation.span;
  const bool has_condition = tokens_.take_if_word("where");
  if (has_condition) children.push_back(expression(Power::loosest));
  const char* wanted = has_condition ? "')'" : "'where' or ')'";
  node.span.end = tokens_.expect(Token::Kind::close_round, wanted).span.end;
}

}  // namespace oriel::rules
