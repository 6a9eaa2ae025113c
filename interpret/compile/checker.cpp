#include "interpret/compile/checker.h"

#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "kernel/base/text/suggest.h"
#include "model/description/surface_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// Kinds of expressions that ask for classes or relations.
bool speaks_of_features(Syntax::Kind kind) {
  using enum Syntax::Kind;
  return kind == quantifier || kind == aggregate || kind == distance || kind == group_gap ||
         kind == is_test;
}

bool is_arithmetic(Op op) {
  return op == Op::add || op == Op::subtract || op == Op::multiply || op == Op::divide;
}

}  // namespace

ExprId Checker::condition(const Syntax& syntax) {
  in_expression_ = 0;
  return check_as_condition(syntax);
}

ExprId Checker::term(const Syntax& syntax) {
  in_expression_ = 0;
  const ExprId id = check(syntax);
  if (id == kNoExpr || code_.at(id).type != Type::text) return id;
  return code_.fail(Code::R232, syntax.span,
                    fmt::format("'{}' is a text; a score is made of numbers and conditions",
                                code_.text_of(syntax)));
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
  const Dimension found = code_.at(id).dimension;
  if (!is_constant(code_.at(id)))
    return code_.fail(
        Code::R232, syntax.span,
        fmt::format("'{}' differs from feature to feature; a fixed value is needed here",
                    code_.text_of(syntax)));
  if (!dimension || found == *dimension) return id;
  if (found.is_plain() && is_bare_number(syntax))
    return code_.fail(Code::R231, syntax.span,
                      fmt::format("{} is needed here: write {} {}", describe(*dimension),
                                  code_.text_of(syntax), unit_of(*dimension)));
  return code_.fail(Code::R230, syntax.span,
                    fmt::format("'{}' is {}; {} is needed here", code_.text_of(syntax),
                                describe(found), describe(*dimension)));
}

/// Reports it once; whatever is looked at afterwards fails in silence.
bool Checker::is_too_much(SourceSpan where) {
  ++in_expression_;
  ++in_pack_;
  if (in_pack_ == kMostInPack)
    code_.fail(Code::R222, where,
               "with their macros the expressions of this pack come to more than 200000 parts");
  else if (in_expression_ == kMostInExpression)
    code_.fail(Code::R222, where, "with its macros this expression comes to more than 10000 parts");
  return in_pack_ >= kMostInPack || in_expression_ >= kMostInExpression;
}

ExprId Checker::check(const Syntax& syntax) {
  if (is_too_much(syntax.span)) return kNoExpr;
  if (is_of_surfaces_ && speaks_of_features(syntax.kind))
    return code_.fail(
        Code::R232, syntax.span,
        fmt::format("'{}' speaks of features; of a surface only its own attributes are "
                    "known (part = CLASS asks for the feature it belongs to)",
                    code_.text_of(syntax)));
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
      return code_.call(syntax, check_numbers(syntax));
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
      return code_.negate(syntax, check_as_number(syntax.children[0]));
    case Kind::negation:
      return code_.logic(syntax, Op::negation, check_conditions(syntax));
    case Kind::binary:
      return is_arithmetic(op_of(syntax.symbol)) ? code_.arithmetic(syntax, check_numbers(syntax))
                                                 : check_comparison(syntax);
    case Kind::all_of:
      return code_.logic(syntax, Op::all_of, check_conditions(syntax));
    case Kind::any_of:
      return code_.logic(syntax, Op::any_of, check_conditions(syntax));
    case Kind::range_test:
      return code_.range(syntax, check_numbers(syntax));
    case Kind::list_test:
      return check_list(syntax);
    case Kind::similarity:
      return code_.similarity(syntax, check_numbers(syntax));
  }
  return kNoExpr;
}

ExprId Checker::check_number(const Syntax& syntax) {
  Expr expr{.op = Op::constant, .number = syntax.number, .span = syntax.span};
  if (syntax.name == "mm@map") {
    if (!is_map_allowed_)
      return code_.fail(Code::R235, syntax.span,
                        "mm@map has a meaning only under 'generalise:', where there is a scale");
    Expr length{.op = Op::map_length, .dimension = {1, 0}, .span = syntax.span};
    length.args = {code_.add(std::move(expr))};
    return length.args[0] == kNoExpr ? kNoExpr : code_.add(std::move(length));
  }
  if (const auto unit = unit_word(syntax.name)) {
    expr.dimension = unit->dimension;
    // 80 cm is 0.8, not 80 · 0.01: dividing by a whole number rounds once.
    expr.number = unit->factor < 1 ? syntax.number / std::round(1 / unit->factor) : syntax.number;
  }
  return code_.add(std::move(expr));
}

const std::vector<AttributeInfo>& Checker::schema() const {
  return is_of_surfaces_ ? surface_schema() : feature_schema();
}

std::vector<std::string> Checker::words_for(std::size_t column) const {
  if (is_of_surfaces_ && column == column_of(SurfaceAttribute::part))
    return names_of(pack_->classes);
  return schema()[column].words;
}

ExprId Checker::check_parameter(const Syntax& syntax) {
  const auto index = lookup_.param(syntax);
  if (!index) return kNoExpr;
  const Dimension dimension = pack_->params[static_cast<std::size_t>(*index)].dimension;
  return code_.add(
      {.op = Op::parameter, .dimension = dimension, .index = *index, .span = syntax.span});
}

std::optional<int> Checker::level_of(const Syntax& syntax) {
  const bool is_in_macro = macro_depth_ > 0;
  if (is_in_relation_) {
    if (syntax.scope != Syntax::Scope::other) return 0;
    if (!is_in_macro) return 1;
  }
  if (syntax.scope == Syntax::Scope::here) return level_;
  if (syntax.scope == Syntax::Scope::self && level_ <= 1) return 0;
  if (syntax.scope == Syntax::Scope::other && level_ >= 1 && !is_in_macro) return level_;
  std::string sentence = "'self' does not reach into a quantifier inside a quantifier";
  if (syntax.scope == Syntax::Scope::other)
    sentence = is_in_macro ? "a macro cannot say 'other'; it is used outside 'where', too"
                           : "'other' has a meaning only after 'where'";
  findings_->error(Code::R236, syntax.span, sentence);
  return std::nullopt;
}

ExprId Checker::check_name(const Syntax& syntax) {
  if (const int column = index_of(schema(), syntax.name); column >= 0)
    return check_attribute(syntax, column);
  const int macro = index_of(names_->macros, syntax.name);
  if (macro >= 0 && syntax.scope == Syntax::Scope::here)
    return check_macro(syntax, names_->macros[static_cast<std::size_t>(macro)]);
  if (contains(names_->broken_macros, syntax.name)) return kNoExpr;
  if (syntax.name == kScaleName && syntax.scope == Syntax::Scope::here) return check_scale(syntax);
  lookup_.report_unknown(syntax, schema());
  return kNoExpr;
}

ExprId Checker::check_scale(const Syntax& syntax) {
  if (is_map_allowed_) return code_.add({.op = Op::scale, .span = syntax.span});
  return code_.fail(
      Code::R235, syntax.span,
      "'scale' has a meaning only under 'generalise:', where there is a target scale");
}

ExprId Checker::check_attribute(const Syntax& syntax, int column) {
  const auto level = level_of(syntax);
  if (!level) return kNoExpr;
  const Unit unit = schema()[static_cast<std::size_t>(column)].unit;
  Expr expr{.op = Op::attribute,
            .dimension = dimension_of(unit),
            .index = column,
            .level = *level,
            .span = syntax.span};
  if (unit == Unit::text) expr.type = Type::text;
  if (unit == Unit::yes_no) {
    expr.op = Op::flag;
    expr.type = Type::yes_no;
  }
  return code_.add_of_feature(std::move(expr));
}

ExprId Checker::check_macro(const Syntax& syntax, Macro& macro) {
  if (macro.is_open)
    return code_.fail(Code::R247, syntax.span,
                      fmt::format("the macro '{}' uses itself", macro.name));
  if (macro_depth_ >= kDeepestExpression)
    return code_.fail(Code::R222, syntax.span, "macros nest no deeper than 64 levels");
  macro.is_used = true;
  macro.is_open = true;
  ++macro_depth_;
  const ExprId id = check(macro.body);
  --macro_depth_;
  macro.is_open = false;
  return id;
}

ExprId Checker::check_distance(const Syntax& syntax) {
  Syntax named = syntax;
  named.scope = Syntax::Scope::self;
  const auto self = level_of(named);
  if (!self) return kNoExpr;
  named.scope = Syntax::Scope::other;
  const auto other = level_of(named);
  return other ? code_.distance_along(syntax.span, *self, *other) : kNoExpr;
}

/// A column after those of the schema, which plan() fills (groups.h).
ExprId Checker::check_group_gap(const Syntax& syntax) {
  if (!is_of_group_)
    return code_.fail(Code::R271, syntax.span,
                      "gap(members) has a meaning only in the 'when' of an entry for a group");
  Syntax named = syntax;
  named.scope = Syntax::Scope::self;
  const auto level = level_of(named);
  if (!level) return kNoExpr;
  Expr expr{.op = Op::attribute,
            .dimension = {1, 0},
            .index = static_cast<int>(kAttributes.size()),
            .level = *level,
            .span = syntax.span};
  return code_.add_of_feature(std::move(expr));
}

ExprId Checker::check_is(const Syntax& syntax) {
  const auto level = level_of(syntax);
  if (!level) return kNoExpr;
  return syntax.is_of_host ? check_host(syntax, *level) : check_class(syntax, *level);
}

ExprId Checker::check_class(const Syntax& syntax, int level) {
  if (is_in_relation_)
    return code_.fail(
        Code::R249, syntax.span,
        "a relation is found before any class is known; ask for the class where the relation "
        "is used, as in exists(R where is CLASS)");
  const ClassId id = lookup_.class_of(syntax);
  if (id == kNoClass) return kNoExpr;
  return code_.add_of_feature({.op = Op::is_class,
                               .type = Type::yes_no,
                               .index = id,
                               .level = level,
                               .is_previous = is_previous_,
                               .span = syntax.span});
}

/// host is wall: by the inclination of the host's facet. host is CLASS: exists(host where is
/// CLASS).
ExprId Checker::check_host(const Syntax& syntax, int level) {
  const auto kind = std::ranges::find(host_kinds(), syntax.name);
  if (kind != host_kinds().end())
    return code_.add_of_feature({.op = Op::facet_is,
                                 .type = Type::yes_no,
                                 .index = static_cast<int>(kind - host_kinds().begin()),
                                 .level = level,
                                 .span = syntax.span});
  const ExprId where = check_class(syntax, level + 1);
  if (where == kNoExpr) return kNoExpr;
  return code_.quantifier({.op = Op::exists,
                           .type = Type::yes_no,
                           .index = index_of(relation_schema(), "host"),
                           .level = level,
                           .span = syntax.span},
                          where);
}

/// The relation that a quantifier leads over, or nothing and an error.
std::optional<int> Checker::relation_of(const Syntax& syntax) {
  if (is_in_relation_) {
    code_.fail(Code::R249, syntax.span,
               "a relation is found from two features alone; a quantifier looks at more");
    return std::nullopt;
  }
  const auto relation = lookup_.relation(syntax);
  if (!relation) return std::nullopt;
  // `host is CLASS` needs one level more.
  if (level_ + 2 < kMostLevels) return relation;
  code_.fail(Code::R222, syntax.span, "quantifiers nest no deeper than two levels");
  return std::nullopt;
}

ExprId Checker::check_quantifier(const Syntax& syntax) {
  const auto relation = relation_of(syntax);
  if (!relation) return kNoExpr;
  ExprId where = kNoExpr;
  if (!syntax.children.empty()) {
    ++level_;
    where = check_as_condition(syntax.children[0]);
    --level_;
    if (where == kNoExpr) return kNoExpr;
  }
  Expr expr{.op = Op::count, .index = *relation, .level = level_, .span = syntax.span};
  if (syntax.name == "exists") expr.op = Op::exists;
  if (syntax.name == "none") expr.op = Op::none;
  if (syntax.name == "all") expr.op = Op::all;
  if (expr.op != Op::count) expr.type = Type::yes_no;
  return code_.quantifier(std::move(expr), where);
}

ExprId Checker::check_aggregate(const Syntax& syntax) {
  const auto relation = relation_of(syntax);
  if (!relation) return kNoExpr;
  Expr expr{.op = Op::mean, .index = *relation, .level = level_, .span = syntax.span};
  if (syntax.name == "min") expr.op = Op::least;
  if (syntax.name == "max") expr.op = Op::greatest;
  const bool has_condition = syntax.children.size() > 1;
  ++level_;
  expr.value = check_as_number(syntax.children[0]);
  const ExprId where = has_condition ? check_as_condition(syntax.children[1]) : kNoExpr;
  --level_;
  if (expr.value == kNoExpr || (has_condition && where == kNoExpr)) return kNoExpr;
  expr.dimension = code_.at(expr.value).dimension;
  return code_.quantifier(std::move(expr), where);
}

ExprId Checker::check_as_number(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || code_.at(id).type == Type::number) return id;
  return code_.fail(Code::R232, syntax.span,
                    fmt::format("'{}' is {}; a number is needed here", code_.text_of(syntax),
                                describe(code_.at(id))));
}

ExprId Checker::check_as_condition(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || code_.at(id).type == Type::yes_no) return id;
  return code_.fail(Code::R232, syntax.span,
                    fmt::format("'{}' is {}; a condition is needed here", code_.text_of(syntax),
                                describe(code_.at(id))));
}

std::vector<ExprId> Checker::check_numbers(const Syntax& syntax) {
  std::vector<ExprId> ids;
  for (const Syntax& child : syntax.children) ids.push_back(check_as_number(child));
  return ids;
}

std::vector<ExprId> Checker::check_conditions(const Syntax& syntax) {
  std::vector<ExprId> ids;
  for (const Syntax& child : syntax.children) ids.push_back(check_as_condition(child));
  return ids;
}

ExprId Checker::check_comparison(const Syntax& syntax) {
  const Syntax& left = syntax.children[0];
  const Syntax& right = syntax.children[1];
  Expr expr{.op = op_of(syntax.symbol), .type = Type::yes_no, .span = syntax.span};
  const ExprId first = check(left);
  if (first != kNoExpr && code_.at(first).type == Type::text) {
    if (expr.op != Op::equal && expr.op != Op::not_equal)
      return code_.fail(Code::R232, syntax.name_span,
                        fmt::format("'{}' is a text; texts are compared with =, != and in [..]",
                                    code_.text_of(left)));
    expr.args = {first, check_word(right, first)};
    return expr.args[1] == kNoExpr ? kNoExpr : code_.add(std::move(expr));
  }
  if (first != kNoExpr && code_.at(first).type == Type::yes_no)
    return code_.fail(Code::R232, left.span,
                      fmt::format("'{}' is yes or no already; write it alone, or 'not' in front",
                                  code_.text_of(left)));
  // The word that an unknown text is compared with is not missed as an attribute.
  const bool is_word = right.kind == Syntax::Kind::name && right.scope == Syntax::Scope::here;
  if (first == kNoExpr && is_word && (expr.op == Op::equal || expr.op == Op::not_equal))
    return kNoExpr;
  return code_.comparison(syntax, {first, check_as_number(right)});
}

ExprId Checker::check_list(const Syntax& syntax) {
  Expr expr{.op = Op::in_list, .type = Type::yes_no, .span = syntax.span};
  const Syntax& value = syntax.children[0];
  expr.args.push_back(check(value));
  if (expr.args[0] == kNoExpr) return kNoExpr;
  const Type type = code_.at(expr.args[0]).type;
  if (type == Type::yes_no)
    return code_.fail(
        Code::R232, value.span,
        fmt::format("'{}' is yes or no; write it alone, or 'not' in front", code_.text_of(value)));
  if (type == Type::number && !code_.at(expr.args[0]).dimension.is_plain())
    return report_list_of_measures(syntax, code_.at(expr.args[0]).dimension);
  bool is_good = true;
  for (std::size_t i = 1; i < syntax.children.size(); ++i) {
    const Syntax& member = syntax.children[i];
    const ExprId id =
        type == Type::text ? check_word(member, expr.args[0]) : check_as_number(member);
    is_good = is_good && id != kNoExpr &&
              (type == Type::text || code_.expect_same(value, expr.args[0], member, id));
    expr.args.push_back(id);
  }
  return is_good ? code_.add(std::move(expr)) : kNoExpr;
}

/// What is measured is never exactly one of a list: a range is meant.
ExprId Checker::report_list_of_measures(const Syntax& syntax, Dimension dimension) {
  const auto bound = [&](const Syntax& member) {
    const std::string_view text = code_.text_of(member);
    return is_bare_number(member) ? fmt::format("{} {}", text, unit_of(dimension))
                                  : std::string(text);
  };
  const std::string_view value = code_.text_of(syntax.children[0]);
  return code_.fail(
      Code::R232, syntax.span,
      fmt::format("'{}' is {}, which is never exactly one of a list; a range is written '{} in {} "
                  ".. {}'",
                  value, describe(dimension), value, bound(syntax.children[1]),
                  bound(syntax.children.back())));
}

/// The right side of a text: a word, or another text by its full name.
ExprId Checker::check_word(const Syntax& syntax, ExprId text) {
  const bool is_bare = syntax.kind == Syntax::Kind::name && syntax.scope == Syntax::Scope::here;
  if (!is_bare) {
    const ExprId id = check(syntax);
    if (id == kNoExpr || code_.at(id).type == Type::text) return id;
    return code_.fail(Code::R232, syntax.span,
                      fmt::format("'{}' is {}; a word is needed here", code_.text_of(syntax),
                                  describe(code_.at(id))));
  }
  const auto column = static_cast<std::size_t>(code_.at(text).index);
  const auto words = words_for(column);
  if (!words.empty() && std::ranges::find(words, syntax.name) == words.end()) {
    std::string advice = did_you_mean(syntax.name, words);
    if (advice.empty()) advice = fmt::format(" (it is one of {})", join(words));
    return code_.fail(
        Code::R234, syntax.span,
        fmt::format("'{}' is never '{}'{}", schema()[column].name, syntax.name, advice));
  }
  return code_.word(syntax.name, syntax.span);
}

}  // namespace oriel::rules
