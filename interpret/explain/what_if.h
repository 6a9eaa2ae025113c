#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/explain/explain.h"
#include "interpret/labelling/candidates.h"
#include "interpret/pack/pack.h"
#include "interpret/params/settable_pack.h"
#include "interpret/relabelling/relabelling.h"
#include "interpret/relabelling/rule_uses.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::rules {

/// Labels one building with the params of a pack at other values than the pack says. The pack, the
/// table and the graph must outlive it.
class WhatIf {
 public:
  WhatIf(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph);

  /// What is decided for the feature in `row` with that param at `value` and all others as the pack
  /// says; nothing if the pack would be refused with it (an empty range, hosts that overlap).
  std::optional<Choice> label(std::size_t param, double value, std::size_t row);

  /// The pack as it says, which may be changed for a while, and the building as it was labelled
  /// with it; valid until something is labelled.
  [[nodiscard]] Pack& pack() { return varied_.pack(); }
  [[nodiscard]] const EvaluationContext& context() { return relabelling_.context(); }

 private:
  const RuleUses::Affected& affected_by(std::size_t param);

  SettablePack varied_;
  RuleUses uses_;
  /// By param, as soon as it was asked.
  std::vector<std::optional<RuleUses::Affected>> affected_;
  Relabelling relabelling_;
};

/// Explainer::find_flip.
FlipSearch find_flip(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph,
                     FeatureId feature, const IsGivenUp& is_given_up);

}  // namespace oriel::rules
