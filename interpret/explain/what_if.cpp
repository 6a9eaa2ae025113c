#include "interpret/explain/what_if.h"

#include "interpret/evaluate/arithmetic.h"

#include <algorithm>

namespace oriel::rules {

namespace {

void refold(const Pack& pack, ExprId id, double& value) {
  if (id != kNoExpr) value = fold(pack, id).value_or(value);
}

bool is_sound_range(const HostRange& range) {
  return range.low_deg <= range.high_deg && range.low_deg >= 0 && range.high_deg <= 180;
}

/// True if it is asked for before the first rule: by relations and kinds of host facets.
bool is_laid_out(const Pack& pack, std::size_t param) {
  for (const HostRange& range : {pack.hosts.wall, pack.hosts.roof, pack.hosts.ground})
    if (depends_on(pack, range.low, param, true) || depends_on(pack, range.high, param, true))
      return true;
  return std::ranges::any_of(pack.relations, [&](const RelationDefinition& relation) {
    return depends_on(pack, relation.where, param, true);
  });
}

}  // namespace

bool depends_on(const Pack& pack, ExprId id, std::size_t param, bool is_thorough) {
  if (id == kNoExpr) return false;
  const Expr& expr = pack.code[static_cast<std::size_t>(id)];
  if (expr.op == Op::parameter) return expr.index == static_cast<int>(param);
  const auto does = [&](ExprId part) { return depends_on(pack, part, param, is_thorough); };
  if (std::ranges::any_of(expr.args, does) || does(expr.value)) return true;
  return is_thorough && (does(expr.filter) || does(expr.join));
}

WhatIf::WhatIf(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph)
    : pack_(pack), table_(&table), graph_(&graph) {
  context_.emplace(pack_, table, graph);
  run(*context_);
}

std::vector<Choice> WhatIf::run(EvaluationContext& context) const {
  for (auto& members : context.membership) std::ranges::fill(members, Truth::no);
  context.previous.clear();
  return Labelling(pack_, context).run();
}

/// False if the pack would be refused with that value.
bool WhatIf::set(std::size_t param, double value) {
  pack_.params[param].value = value;
  for (HostRange* range : {&pack_.hosts.wall, &pack_.hosts.roof, &pack_.hosts.ground}) {
    refold(pack_, range->low, range->low_deg);
    refold(pack_, range->high, range->high_deg);
  }
  Decide& decide = pack_.decide;
  refold(pack_, decide.min_score_of, decide.min_score);
  refold(pack_, decide.evidence.most_of, decide.evidence.most);
  return is_sound();
}

bool WhatIf::is_sound(const Ramp& ramp) const {
  const auto from = fold(pack_, ramp.from), to = fold(pack_, ramp.to);
  return !from || !to || *from <= *to;
}

/// What the loader would find (R212).
bool WhatIf::is_sound() const {
  const Hosts& hosts = pack_.hosts;
  if (!is_sound_range(hosts.wall) || !is_sound_range(hosts.roof) || !is_sound_range(hosts.ground) ||
      is_overlapping(hosts.wall, hosts.roof) || is_overlapping(hosts.wall, hosts.ground) ||
      is_overlapping(hosts.roof, hosts.ground))
    return false;
  const Decide& decide = pack_.decide;
  if (decide.min_score < 0 || decide.min_score > 1 || decide.evidence.most < 0 ||
      (decide.evidence.is_written() && 2 * decide.evidence.most > decide.ambiguous_below))
    return false;
  for (const Expr& expr : pack_.code)
    if (expr.op == Op::in_range && !is_sound(Ramp{expr.args[1], expr.args[2]})) return false;
  for (const Rule& rule : pack_.rules)
    for (const ScoreTerm& term : rule.score) {
      if ((term.rise && !is_sound(*term.rise)) || (term.fall && !is_sound(*term.fall)))
        return false;
      if (term.rise && term.fall && !is_sound(Ramp{term.rise->to, term.fall->from})) return false;
    }
  return true;
}

std::optional<Choice> WhatIf::label(std::size_t param, double value, std::size_t row) {
  const double said = pack_.params[param].value;
  std::optional<Choice> choice;
  if (set(param, value)) {
    const bool is_asked_first = is_laid_out(pack_, param);
    if (!changed_ || is_asked_first || is_laid_out_anew_) changed_.emplace(pack_, *table_, *graph_);
    is_laid_out_anew_ = is_asked_first;
    choice = run(*changed_)[row];
  }
  if (!set(param, said)) return std::nullopt;
  return choice;
}

}  // namespace oriel::rules
