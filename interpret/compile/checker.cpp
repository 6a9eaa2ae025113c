#include "interpret/compile/checker.h"

#include "interpret/compile/fold.h"
#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "interpret/language/suggest.h"
#include "kernel/model/description/surface_table.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

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

const std::vector<std::string>& host_kinds() {
  static const std::vector<std::string> kinds = {"wall", "roof", "ground"};
  return kinds;
}

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
bool Checker::is_too_much(SourceSpan where) {
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

ExprId Checker::fail(Code code, SourceSpan where, std::string sentence) {
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

const std::vector<AttributeInfo>& Checker::schema() const {
  return is_of_surfaces_ ? surface_schema() : feature_schema();
}

std::vector<std::string> Checker::words_for(std::size_t column) const {
  if (is_of_surfaces_ && column == column_of(SurfaceAttribute::part))
    return names_of(pack_->classes);
  return schema()[column].words;
}

ExprId Checker::check_parameter(const Syntax& syntax) {
  const int index = index_of(pack_->params, syntax.name);
  if (index < 0) {
    if (contains(names_->broken_params, syntax.name)) return kNoExpr;
    return fail(Code::R206, syntax.span,
                fmt::format("unknown param '{}'{}", syntax.name,
                            did_you_mean(syntax.name, names_of(pack_->params))));
  }
  names_->is_param_used[static_cast<std::size_t>(index)] = true;
  const Param& param = pack_->params[static_cast<std::size_t>(index)];
  return add(
      {.op = Op::parameter, .dimension = param.dimension, .index = index, .span = syntax.span});
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
  report_unknown_name(syntax);
  return kNoExpr;
}

ExprId Checker::check_scale(const Syntax& syntax) {
  if (is_map_allowed_) return add({.op = Op::scale, .span = syntax.span});
  return fail(Code::R235, syntax.span,
              "'scale' has a meaning only under 'generalise:', where there is a target scale");
}

void Checker::report_unknown_name(const Syntax& syntax) {
  const auto macros = names_of(names_->macros);
  std::vector<std::string> candidates = names_of(schema());
  candidates.insert(candidates.end(), macros.begin(), macros.end());
  const std::string near = nearest(syntax.name, candidates);
  const bool is_macro = contains(macros, near);
  findings_->error(is_macro ? Code::R208 : Code::R204, syntax.name_span,
                   fmt::format("unknown {} '{}'{}", is_macro ? "macro" : "attribute", syntax.name,
                               did_you_mean(syntax.name, candidates)));
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
  expr.levels = 1U << static_cast<unsigned>(*level);
  if (unit == Unit::text) expr.type = Type::text;
  if (unit == Unit::yes_no) {
    expr.op = Op::flag;
    expr.type = Type::yes_no;
  }
  return add(std::move(expr));
}

ExprId Checker::check_macro(const Syntax& syntax, Macro& macro) {
  if (macro.is_open)
    return fail(Code::R247, syntax.span, fmt::format("the macro '{}' needs itself", macro.name));
  if (macro_depth_ >= kDeepestExpression)
    return fail(Code::R222, syntax.span, "macros nest no deeper than 64 levels");
  macro.is_used = true;
  macro.is_open = true;
  ++macro_depth_;
  const ExprId id = check(macro.body);
  --macro_depth_;
  macro.is_open = false;
  return id;
}

/// Of the middles of their lower edges in the facade: sqrt((self.along - other.along)^2 +
/// (self.base_height - other.base_height)^2).
ExprId Checker::check_distance(const Syntax& syntax) {
  const auto value_of = [&](Attribute attribute, Syntax::Scope scope) {
    const Syntax named{.span = syntax.span,
                       .name_span = syntax.name_span,
                       .name = info_of(attribute).name,
                       .scope = scope};
    return check_attribute(named, static_cast<int>(column_of(attribute)));
  };
  Expr sum{.op = Op::add, .dimension = {2, 0}, .span = syntax.span};
  for (const Attribute attribute : {Attribute::along, Attribute::base_height}) {
    Expr difference{.op = Op::subtract, .dimension = {1, 0}, .span = syntax.span};
    for (const auto scope : {Syntax::Scope::self, Syntax::Scope::other}) {
      difference.args.push_back(value_of(attribute, scope));
      if (difference.args.back() == kNoExpr) return kNoExpr;
    }
    const ExprId id = add(std::move(difference));
    if (id == kNoExpr) return kNoExpr;
    sum.args.push_back(
        add({.op = Op::multiply, .dimension = {2, 0}, .args = {id, id}, .span = syntax.span}));
    if (sum.args.back() == kNoExpr) return kNoExpr;
  }
  const ExprId squares = add(std::move(sum));
  if (squares == kNoExpr) return kNoExpr;
  return add({.op = Op::square_root, .dimension = {1, 0}, .args = {squares}, .span = syntax.span});
}

/// A column behind those of the schema, which plan() fills (groups.h).
ExprId Checker::check_group_gap(const Syntax& syntax) {
  if (!is_of_group_)
    return fail(Code::R271, syntax.span,
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
  expr.levels = 1U << static_cast<unsigned>(*level);
  return add(std::move(expr));
}

ExprId Checker::check_is(const Syntax& syntax) {
  const auto level = level_of(syntax);
  if (!level) return kNoExpr;
  if (syntax.is_of_host) return check_host(syntax, *level);
  if (is_in_relation_) return refuse_class(syntax);
  const ClassId id = index_of(pack_->classes, syntax.name);
  if (id < 0) {
    report_unknown_class(syntax);
    return kNoExpr;
  }
  Expr expr{
      .op = Op::is_class, .type = Type::yes_no, .index = id, .level = *level, .span = syntax.span};
  expr.is_previous = is_previous_;
  expr.levels = 1U << static_cast<unsigned>(*level);
  return add(std::move(expr));
}

ExprId Checker::refuse_class(const Syntax& syntax) {
  return fail(Code::R249, syntax.span,
              "a relation is found before any class is known; ask for the class where the relation "
              "is used, as in exists(R where is CLASS)");
}

void Checker::report_unknown_class(const Syntax& syntax) {
  const std::string& name = syntax.name;
  if (!syntax.is_of_host && contains(host_kinds(), name)) {
    findings_->error(Code::R205, syntax.name_span,
                     fmt::format("'{}' is a kind of host facet: write 'host is {}'", name, name));
    return;
  }
  auto candidates = names_of(pack_->classes);
  if (syntax.is_of_host)
    candidates.insert(candidates.end(), host_kinds().begin(), host_kinds().end());
  findings_->error(Code::R205, syntax.name_span,
                   fmt::format("unknown class '{}'{}", name, did_you_mean(name, candidates)));
}

/// host is wall: by the inclination of the host's facet. host is CLASS: exists(host where is
/// CLASS).
ExprId Checker::check_host(const Syntax& syntax, int level) {
  const auto kind = std::ranges::find(host_kinds(), syntax.name);
  if (kind != host_kinds().end()) {
    const int index = static_cast<int>(kind - host_kinds().begin());
    Expr expr{.op = Op::facet_is,
              .type = Type::yes_no,
              .index = index,
              .level = level,
              .span = syntax.span};
    expr.levels = 1U << static_cast<unsigned>(level);
    return add(std::move(expr));
  }
  if (is_in_relation_) return refuse_class(syntax);
  const ClassId id = index_of(pack_->classes, syntax.name);
  if (id < 0) {
    report_unknown_class(syntax);
    return kNoExpr;
  }
  Expr test{.op = Op::is_class,
            .type = Type::yes_no,
            .index = id,
            .level = level + 1,
            .span = syntax.span};
  test.is_previous = is_previous_;
  test.levels = 1U << static_cast<unsigned>(level + 1);
  const ExprId where = add(std::move(test));
  if (where == kNoExpr) return kNoExpr;
  Expr exists{.op = Op::exists,
              .type = Type::yes_no,
              .index = index_of(relation_schema(), "host"),
              .level = level,
              .span = syntax.span};
  return make_quantifier(std::move(exists), where);
}

/// The relation that a quantifier leads over, or nothing and an error.
std::optional<int> Checker::relation_of(const Syntax& syntax) {
  if (is_in_relation_) {
    fail(Code::R249, syntax.span,
         "a relation is found from two features alone; a quantifier looks at more");
    return std::nullopt;
  }
  const int relation = relation_number(*pack_, syntax.relation);
  if (relation < 0 && contains(names_->broken_relations, syntax.relation)) return std::nullopt;
  if (relation < 0) {
    fail(Code::R207, syntax.relation_span,
         fmt::format("unknown relation '{}'{}", syntax.relation,
                     did_you_mean(syntax.relation, relation_names(*pack_))));
    return std::nullopt;
  }
  names_->used_relations.insert(relation);
  // `host is CLASS` needs one level more.
  if (level_ + 2 < kMostLevels) return relation;
  fail(Code::R222, syntax.span, "quantifiers nest no deeper than two levels");
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
  return make_quantifier(std::move(expr), where);
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
  expr.dimension = at(expr.value).dimension;
  return make_quantifier(std::move(expr), where);
}

/// Conditions on the other feature alone are pushed out of the join: they are evaluated once for
/// every feature, not once for every pair.
ExprId Checker::make_quantifier(Expr expr, ExprId where) {
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

bool is_bare_number(const Syntax& syntax) {
  if (syntax.kind == Syntax::Kind::negate) return is_bare_number(syntax.children[0]);
  return syntax.kind == Syntax::Kind::number && syntax.name.empty();
}

ExprId Checker::check_as_number(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || at(id).type == Type::number) return id;
  return fail(
      Code::R232, syntax.span,
      fmt::format("'{}' is {}; a number is needed here", text_of(syntax), describe(at(id))));
}

ExprId Checker::check_as_condition(const Syntax& syntax) {
  const ExprId id = check(syntax);
  if (id == kNoExpr || at(id).type == Type::yes_no) return id;
  return fail(
      Code::R232, syntax.span,
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
    return fail(Code::R230, syntax.span,
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
    return fail(Code::R230, syntax.span, "a unit to a power above 9 has no meaning here");
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
          Code::R232, syntax.name_span,
          fmt::format("'{}' is a text; texts are compared with =, != and in [..]", text_of(left)));
    expr.args = {first, check_word(right, first)};
    return expr.args[1] == kNoExpr ? kNoExpr : add(std::move(expr));
  }
  if (first != kNoExpr && at(first).type == Type::yes_no)
    return fail(
        Code::R232, left.span,
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
    return fail(Code::R212, {syntax.children[1].span.begin, syntax.children[2].span.end},
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
        Code::R232, value.span,
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
    return fail(Code::R230, syntax.children[2].span,
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
        Code::R232, syntax.span,
        fmt::format("'{}' is {}; a word is needed here", text_of(syntax), describe(at(id))));
  }
  const auto column = static_cast<std::size_t>(at(text).index);
  const auto words = words_for(column);
  if (!words.empty() && std::ranges::find(words, syntax.name) == words.end()) {
    std::string advice = did_you_mean(syntax.name, words);
    if (advice.empty()) advice = fmt::format(" (it is one of {})", join(words));
    return fail(Code::R234, syntax.span,
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
  fail(Code::R230, right.span,
       fmt::format("'{}' is {} and '{}' is {}", text_of(left), describe(p), text_of(right),
                   describe(q)));
  return false;
}

bool Checker::report_missing_unit(const Syntax& number, const Syntax& other, Dimension wanted) {
  if (!is_bare_number(number) || wanted.is_plain()) return false;
  fail(Code::R231, number.span,
       fmt::format("'{}' is {}: write {} {}", text_of(other), describe(wanted), text_of(number),
                   unit_of(wanted)));
  return true;
}

}  // namespace oriel::rules
