#include "interpret/relabelling/rule_uses.h"

#include "interpret/compile/counts.h"
#include "kernel/base/index.h"
#include "model/description/feature_table.h"

#include <algorithm>

namespace oriel::rules {

RuleUses::RuleUses(const Pack& pack) : pack_(&pack), is_recursive_(pack.rules.size()) {
  for (const RuleStep& step : pack.steps)
    for (const int rule : step.rules) is_recursive_[at(rule)] = step.is_recursive;
  const std::size_t relations = relation_schema().size() + pack.relations.size();
  nothing_.params.resize(pack.params.size());
  nothing_.relations.resize(relations);
  for (const Rule& rule : pack.rules) {
    Uses& uses = rules_.emplace_back(nothing_);
    for (const ExprId id : rule.require) add(id, uses);
    for (const ExprId id : rule.unless) add(id, uses);
    for (const ScoreTerm& term : rule.score) {
      add(term.value, uses);
      for (const auto& ramp : {term.rise, term.fall}) {
        if (!ramp) continue;
        add(ramp->from, uses);
        add(ramp->to, uses);
      }
    }
    std::ranges::sort(uses.classes);
    uses.classes.erase(std::unique(uses.classes.begin(), uses.classes.end()), uses.classes.end());
  }
  for (const RelationDefinition& relation : pack.relations) {
    Uses& uses = relations_.emplace_back(nothing_);
    add(relation.where, uses);
    uses.relations[at(relation.within)] = true;
  }
}

void RuleUses::add(ExprId id, Uses& uses) const {
  if (id == kNoExpr) return;
  const Expr& expr = pack_->code[at(id)];
  if (expr.op == Op::parameter) uses.params[at(expr.index)] = true;
  if (expr.op == Op::is_class) uses.classes.push_back(expr.index);
  if (expr.op == Op::facet_is) uses.has_facets = true;
  if (is_quantifier(expr.op)) uses.relations[at(expr.index)] = true;
  for (const ExprId arg : expr.args) add(arg, uses);
  for (const ExprId part : {expr.filter, expr.join, expr.value}) add(part, uses);
}

bool RuleUses::is_of(const Uses& uses, const Changes& changes) {
  for (std::size_t i = 0; i < changes.params.size(); ++i)
    if (changes.params[i] && uses.params[i]) return true;
  for (std::size_t i = 0; i < changes.relations.size(); ++i)
    if (changes.relations[i] && uses.relations[i]) return true;
  return changes.has_other_hosts && uses.has_facets;
}

bool RuleUses::is_moved(ExprId id, const Changes& changes) const {
  Uses uses = nothing_;
  add(id, uses);
  return is_of(uses, changes);
}

RuleUses::Changes RuleUses::changes_of(std::span<const std::size_t> params) const {
  Changes changes{nothing_.params, nothing_.relations, false};
  for (const std::size_t param : params) changes.params[param] = true;
  for (const HostRange& range : {pack_->hosts.wall, pack_->hosts.roof, pack_->hosts.ground})
    changes.has_other_hosts =
        changes.has_other_hosts || is_moved(range.low, changes) || is_moved(range.high, changes);
  const std::size_t built_in = relation_schema().size();
  for (std::size_t i = 0; i < relations_.size(); ++i)
    changes.relations[built_in + i] = is_of(relations_[i], changes);
  return changes;
}

bool RuleUses::decides_anew(std::span<const DroppedPart> without, const Changes& changes) const {
  using Kind = DroppedPart::Kind;
  const auto moves = [&](ExprId id) { return is_moved(id, changes); };
  const Decide& decide = pack_->decide;
  return moves(decide.min_score) || moves(decide.ambiguous_below) || moves(decide.evidence.most) ||
         std::ranges::any_of(without,
                             [](const DroppedPart& part) {
                               return part.kind == Kind::evidence || part.kind == Kind::company ||
                                      part.kind == Kind::typical;
                             }) ||
         std::ranges::any_of(evidence_relations(*pack_),
                             [&](int relation) { return changes.relations[at(relation)]; }) ||
         std::ranges::any_of(pack_->classes, [&](const Class& c) {
           return std::ranges::any_of(c.typical, [&](const Typical& typical) {
             return moves(typical.low) || moves(typical.high);
           });
         });
}

RuleUses::Affected RuleUses::affected_by(std::span<const std::size_t> params,
                                         std::span<const DroppedPart> without) const {
  const Changes changes = changes_of(params);
  Affected affected;
  affected.has_other_relations =
      std::ranges::find(changes.relations, true) != changes.relations.end();
  affected.decides_anew = decides_anew(without, changes);
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const bool is_changed = std::ranges::any_of(without, [&](const DroppedPart& part) {
      return part.owner == static_cast<int>(i) && part.kind != DroppedPart::Kind::typical;
    });
    if (!is_changed && !is_of(rules_[i], changes)) continue;
    affected.rules.push_back(static_cast<int>(i));
    auto& conditions = affected.conditions.emplace_back();
    if (!is_changed) conditions = conditions_of(pack_->rules[i], changes);
  }
  return affected;
}

/// Those that depend on what is changed.
std::vector<ExprId> RuleUses::conditions_of(const Rule& rule, const Changes& changes) const {
  std::vector<ExprId> conditions;
  for (const auto* ids : {&rule.require, &rule.unless})
    for (const ExprId id : *ids)
      if (is_moved(id, changes)) conditions.push_back(id);
  return conditions;
}

}  // namespace oriel::rules
