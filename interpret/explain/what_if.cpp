#include "interpret/explain/what_if.h"

namespace oriel::rules {

WhatIf::WhatIf(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph)
    : varied_(pack),
      uses_(pack),
      affected_(pack.params.size()),
      relabelling_(pack, uses_, table, graph) {}

const RuleUses::Affected& WhatIf::affected_by(std::size_t param) {
  if (!affected_[param])
    affected_[param] = uses_.affected_by({{{param, pack().params[param].value}}, {}});
  return *affected_[param];
}

std::optional<Choice> WhatIf::label(std::size_t param, double value, std::size_t row) {
  const double said = pack().params[param].value;
  std::optional<Choice> choice;
  varied_.set(param, value);
  if (!varied_.find_fault()) choice = relabelling_.choices(pack(), affected_by(param))[row];
  varied_.set(param, said);
  return choice;
}

}  // namespace oriel::rules
