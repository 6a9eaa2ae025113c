#include "interpret/experiment/rule_uses.h"

#include "interpret/compile/counts.h"
#include "kernel/base/index.h"
#include "kernel/model/description/feature_table.h"

#include <algorithm>

namespace oriel::rules {

RuleUses::RuleUses(const Pack& pack) : pack_(&pack), is_recursive_(pack.rules.size()) {
  for (const RuleStep& step : pack.steps)
    for (const int rule : step.rules) is_recursive_[at(rule)] = step.is_recursive;
  const std::size_t relations = relation_schema().size() + pack.relations.size();
  const Uses nothing{
      std::vector<bool>(pack.params.size()), std::vector<bool>(relations), {}, false};
  for (const Rule& rule : pack.rules) {
    Uses& uses = rules_.emplace_back(nothing);
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
    Uses& uses = relations_.emplace_back(nothing);
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

bool RuleUses::is_of(const Uses& uses, const std::vector<bool>& params,
                     const std::vector<bool>& relations, bool has_other_hosts) const {
  for (std::size_t i = 0; i < params.size(); ++i)
    if (params[i] && uses.params[i]) return true;
  for (std::size_t i = 0; i < relations.size(); ++i)
    if (relations[i] && uses.relations[i]) return true;
  return has_other_hosts && uses.has_facets;
}

/// Of a constant.
bool RuleUses::depends(ExprId id, const std::vector<bool>& params) const {
  if (id == kNoExpr) return false;
  const Expr& expr = pack_->code[at(id)];
  if (expr.op == Op::parameter) return params[at(expr.index)];
  return std::ranges::any_of(expr.args, [&](ExprId arg) { return depends(arg, params); });
}

RuleUses::Affected RuleUses::affected_by(const PackChange& change) const {
  using Kind = DroppedPart::Kind;
  Affected affected;
  std::vector<bool> params(pack_->params.size());
  for (const auto& [param, value] : change.params) params[param] = true;
  bool has_other_hosts = false;
  for (const HostRange& range : {pack_->hosts.wall, pack_->hosts.roof, pack_->hosts.ground})
    has_other_hosts = has_other_hosts || depends(range.low, params) || depends(range.high, params);
  const std::size_t built_in = relation_schema().size();
  std::vector<bool> relations(built_in + pack_->relations.size());
  for (std::size_t i = 0; i < relations_.size(); ++i)
    relations[built_in + i] = is_of(relations_[i], params, relations, has_other_hosts);
  affected.has_other_relations = std::ranges::find(relations, true) != relations.end();
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const bool is_changed = std::ranges::any_of(change.without, [&](const DroppedPart& part) {
      return part.owner == static_cast<int>(i) && part.kind != Kind::typical;
    });
    if (is_changed || is_of(rules_[i], params, relations, has_other_hosts))
      affected.rules.push_back(static_cast<int>(i));
  }
  const Decide& decide = pack_->decide;
  affected.decides_anew =
      depends(decide.min_score_of, params) || depends(decide.ambiguous_below_of, params) ||
      depends(decide.evidence.most_of, params) ||
      std::ranges::any_of(change.without,
                          [](const DroppedPart& part) {
                            return part.kind == Kind::evidence || part.kind == Kind::company ||
                                   part.kind == Kind::typical;
                          }) ||
      std::ranges::any_of(evidence_relations(*pack_),
                          [&](int relation) { return relations[at(relation)]; });
  for (const Class& c : pack_->classes)
    for (const Typical& typical : c.typical)
      affected.decides_anew = affected.decides_anew || depends(typical.low_of, params) ||
                              depends(typical.high_of, params);
  return affected;
}

}  // namespace oriel::rules
