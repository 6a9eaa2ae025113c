#include "interpret/compile/checker.h"
#include "interpret/language/parser.h"
#include "interpret/language/suggest.h"
#include "kernel/model/description/surface_table.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

const std::vector<std::string>& host_kinds() {
  static const std::vector<std::string> kinds = {"wall", "roof", "ground"};
  return kinds;
}

}  // namespace

const std::vector<Attribute>& Checker::schema() const {
  return is_of_surfaces_ ? surface_schema() : feature_schema();
}

std::vector<std::string> Checker::words_for(const std::string& attribute) const {
  if (is_of_surfaces_ && attribute == "part") return names_of(pack_->classes);
  return words_of(attribute);
}

ExprId Checker::check_parameter(const Syntax& syntax) {
  const int index = index_of(pack_->params, syntax.name);
  if (index < 0) {
    if (contains(names_->broken_params, syntax.name)) return kNoExpr;
    return fail("R206", syntax.span,
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
  findings_->error("R236", syntax.span, sentence);
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
  return fail("R235", syntax.span,
              "'scale' has a meaning only under 'generalise:', where there is a target scale");
}

void Checker::report_unknown_name(const Syntax& syntax) {
  const auto macros = names_of(names_->macros);
  std::vector<std::string> candidates = names_of(schema());
  candidates.insert(candidates.end(), macros.begin(), macros.end());
  const std::string near = nearest(syntax.name, candidates);
  const bool is_macro = contains(macros, near);
  findings_->error(is_macro ? "R208" : "R204", syntax.name_span,
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
    return fail("R247", syntax.span, fmt::format("the macro '{}' needs itself", macro.name));
  if (macro_depth_ >= kDeepestExpression)
    return fail("R222", syntax.span, "macros nest no deeper than 64 levels");
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
  const auto attribute = [&](const char* name, Syntax::Scope scope) {
    Syntax named{.span = syntax.span, .name_span = syntax.name_span, .name = name, .scope = scope};
    return check_attribute(named, index_of(schema(), name));
  };
  Expr sum{.op = Op::add, .dimension = {2, 0}, .span = syntax.span};
  for (const char* name : {"along", "base_height"}) {
    Expr difference{.op = Op::subtract, .dimension = {1, 0}, .span = syntax.span};
    for (const auto scope : {Syntax::Scope::self, Syntax::Scope::other}) {
      difference.args.push_back(attribute(name, scope));
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

/// A column behind those of the schema, which plan() fills (group_gap.h).
ExprId Checker::check_group_gap(const Syntax& syntax) {
  if (!is_of_group_)
    return fail("R271", syntax.span,
                "gap(members) has a meaning only in the 'when' of an entry for a group");
  Syntax named = syntax;
  named.scope = Syntax::Scope::self;
  const auto level = level_of(named);
  if (!level) return kNoExpr;
  Expr expr{.op = Op::attribute,
            .dimension = {1, 0},
            .index = static_cast<int>(feature_schema().size()),
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
  return fail("R249", syntax.span,
              "a relation is found before any class is known; ask for the class where the relation "
              "is used, as in exists(R where is CLASS)");
}

void Checker::report_unknown_class(const Syntax& syntax) {
  const std::string& name = syntax.name;
  if (!syntax.is_of_host && contains(host_kinds(), name)) {
    findings_->error("R205", syntax.name_span,
                     fmt::format("'{}' is a kind of host facet: write 'host is {}'", name, name));
    return;
  }
  auto candidates = names_of(pack_->classes);
  if (syntax.is_of_host)
    candidates.insert(candidates.end(), host_kinds().begin(), host_kinds().end());
  findings_->error("R205", syntax.name_span,
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
    fail("R249", syntax.span,
         "a relation is found from two features alone; a quantifier looks at more");
    return std::nullopt;
  }
  const int relation = relation_number(*pack_, syntax.relation);
  if (relation < 0 && contains(names_->broken_relations, syntax.relation)) return std::nullopt;
  if (relation < 0) {
    fail("R207", syntax.relation_span,
         fmt::format("unknown relation '{}'{}", syntax.relation,
                     did_you_mean(syntax.relation, relation_names(*pack_))));
    return std::nullopt;
  }
  names_->used_relations.insert(relation);
  // `host is CLASS` needs one level more.
  if (level_ + 2 < kMostLevels) return relation;
  fail("R222", syntax.span, "quantifiers nest no deeper than two levels");
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
  const Span span = expr.span;
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

}  // namespace oriel::rules
