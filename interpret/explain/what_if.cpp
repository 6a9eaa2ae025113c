#include "interpret/explain/what_if.h"

#include "interpret/params/depends_on.h"

#include <algorithm>

namespace oriel::rules {

namespace {

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

WhatIf::WhatIf(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph)
    : pack_(pack), table_(&table), graph_(&graph) {
  context_.emplace(pack_.pack(), table, graph);
  run(*context_);
}

std::vector<Choice> WhatIf::run(EvaluationContext& context) const {
  for (auto& members : context.membership) std::ranges::fill(members, Truth::no);
  context.previous.clear();
  return Labelling(pack_.pack(), context).run();
}

std::optional<Choice> WhatIf::label(std::size_t param, double value, std::size_t row) {
  const double said = pack().params[param].value;
  std::optional<Choice> choice;
  pack_.set(param, value);
  if (!pack_.find_fault()) {
    const bool is_asked_first = is_laid_out(pack(), param);
    if (!changed_ || is_asked_first || is_laid_out_anew_)
      changed_.emplace(pack(), *table_, *graph_);
    is_laid_out_anew_ = is_asked_first;
    choice = run(*changed_)[row];
  }
  pack_.set(param, said);
  return choice;
}

}  // namespace oriel::rules
