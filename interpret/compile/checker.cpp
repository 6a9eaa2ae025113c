#include "interpret/compile/checker.h"

#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Kinds of expressions that need neither classes nor relations.
bool is_known_of_surfaces(Syntax::Kind kind) {
  using enum Syntax::Kind;
  switch (kind) {
    case number:
    case parameter:
    case name:
    case call:
    case negate:
    case negation:
    case binary:
    case all_of:
    case any_of:
    case range_test:
    case list_test:
    case similarity:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::string describe(const Expr& expr) {
  if (expr.type == Type::text) return "a text";
  return expr.type == Type::yes_no ? "yes or no" : describe(expr.dimension);
}

ExprId Checker::condition(const Syntax& syntax) {
  in_expression_ = 0;
  return check_as_condition(syntax);
}

ExprId Checker::term(const Syntax& syntax) {
  in_expression_ = 0;
  const ExprId id = check(syntax);
  if (id == kNoExpr || at(id).type != Type::text) return id;
  return fail(
      Code::R232, syntax.span,
      fmt::format("'{}' is a text; a score is made of numbers and conditions", text_of(syntax)));
}

ExprId Checker::pair_condition(const Syntax& syntax) {
  in_expression_ = 0;
  is_in_relation_ = true;
  const ExprId id = check_as_condition(syntax);
  is_in_relation_ = false;
  return id;
}

ExprId Checker::constant(const Syntax& syntax, std::optional<Dimension> dimension) {
  in_expression_ = 0;
  const ExprId id = check_as_number(syntax);
  if (id == kNoExpr) return kNoExpr;
  const Dimension found = at(id).dimension;
  if (!is_constant(at(id)))
    return fail(Code::R232, syntax.span,
                fmt::format("'{}' differs from feature to feature; a fixed value is needed here",
                            text_of(syntax)));
  if (!dimension || found == *dimension) return id;
  if (found.is_plain() && is_bare_number(syntax))
    return fail(Code::R231, syntax.span,
                fmt::format("{} is needed here: write {} {}", describe(*dimension), text_of(syntax),
                            unit_of(*dimension)));
  return fail(Code::R230, syntax.span,
              fmt::format("'{}' is {}; {} is needed here", text_of(syntax), describe(found),
                          describe(*dimension)));
}

/// Reports it once; whatever is looked at afterwards fails in silence.
bool Checker::is_too_much(Span where) {
  ++in_expression_;
  ++in_pack_;
  if (in_pack_ == kMostInPack)
    fail(Code::R222, where,
         "with their macros the expressions of this pack come to more than 200000 parts");
  else if (in_expression_ == kMostInExpression)
    fail(Code::R222, where, "with its macros this expression comes to more than 10000 parts");
  return in_pack_ >= kMostInPack || in_expression_ >= kMostInExpression;
}

ExprId Checker::check(const Syntax& syntax) {
  if (is_too_much(syntax.span)) return kNoExpr;
  if (is_of_surfaces_ && !is_known_of_surfaces(syntax.kind))
    return fail(Code::R232, syntax.span,
                fmt::format("'{}' speaks of features; of a surface only its own attributes are "
                            "known (part = CLASS asks for the feature it belongs to)",
                            text_of(syntax)));
  return check_by_kind(syntax);
}

ExprId Checker::check_by_kind(const Syntax& syntax) {
  using Kind = Syntax::Kind;
  switch (syntax.kind) {
    case Kind::number:
      return check_number(syntax);
    case Kind::parameter:
      return check_parameter(syntax);
    case Kind::name:
      return check_name(syntax);
    case Kind::call:
      return check_call(syntax);
    case Kind::quantifier:
      return check_quantifier(syntax);
    case Kind::aggregate:
      return check_aggregate(syntax);
    case Kind::distance:
      return check_distance(syntax);
    case Kind::group_gap:
      return check_group_gap(syntax);
    case Kind::is_test:
      return check_is(syntax);
    case Kind::negate:
      return check_negate(syntax);
    case Kind::negation:
      return check_logic(syntax, Op::negation);
    case Kind::binary:
      return check_binary(syntax);
    case Kind::all_of:
      return check_logic(syntax, Op::all_of);
    case Kind::any_of:
      return check_logic(syntax, Op::any_of);
    case Kind::range_test:
      return check_range(syntax);
    case Kind::list_test:
      return check_list(syntax);
    case Kind::similarity:
      return check_similarity(syntax);
  }
  return kNoExpr;
}

ExprId Checker::add(Expr expr) {
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

ExprId Checker::fail(Code code, Span where, std::string sentence) {
  findings_->error(code, where, std::move(sentence));
  return kNoExpr;
}

std::string_view Checker::text_of(const Syntax& syntax) const {
  return findings_->source().text_of(syntax.span);
}

ExprId Checker::check_number(const Syntax& syntax) {
  Expr expr{.op = Op::constant, .number = syntax.number, .span = syntax.span};
  if (syntax.name == "mm@map") {
    if (!is_map_allowed_)
      return fail(Code::R235, syntax.span,
                  "mm@map has a meaning only under 'generalise:', where there is a scale");
    Expr length{.op = Op::map_length, .dimension = {1, 0}, .span = syntax.span};
    length.args = {add(std::move(expr))};
    return length.args[0] == kNoExpr ? kNoExpr : add(std::move(length));
  }
  if (const auto unit = unit_word(syntax.name)) {
    expr.dimension = unit->dimension;
    // 80 cm is 0.8, not 80 · 0.01: dividing by a whole number rounds once.
    expr.number = unit->factor < 1 ? syntax.number / std::round(1 / unit->factor) : syntax.number;
  }
  return add(std::move(expr));
}

int Checker::word_number(const std::string& word) {
  auto& words = pack_->words;
  const auto found = std::ranges::find(words, word);
  if (found != words.end()) return static_cast<int>(found - words.begin());
  words.push_back(word);
  return static_cast<int>(words.size()) - 1;
}

}  // namespace oriel::rules
