#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/explain/explain.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/pack.h"
#include "interpret/params/settable_pack.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::rules {

/// Labels one building with the params of a pack at other values than the pack says. The table and
/// the graph must outlive it.
class WhatIf {
 public:
  WhatIf(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph);

  /// What is decided for the feature in `row` with that param at `value` and all others as the pack
  /// says; nothing if the pack would be refused with it (an empty range, hosts that overlap).
  std::optional<Choice> label(std::size_t param, double value, std::size_t row);

  /// The pack as it says, which may be changed for a while, and the building as it was labelled
  /// with it.
  [[nodiscard]] Pack& pack() { return pack_.pack(); }
  [[nodiscard]] const EvaluationContext& context() const { return *context_; }

 private:
  std::vector<Choice> run(EvaluationContext& context) const;

  SettablePack pack_;
  const FeatureTable* table_;
  const FeatureGraph* graph_;
  /// As the pack says, and the one that is labelled anew with another value.
  std::optional<EvaluationContext> context_, changed_;
  /// `changed_` has relations or kinds of host facets of another value.
  bool is_laid_out_anew_ = false;
};

/// Explainer::find_flip.
FlipSearch find_flip(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph,
                     FeatureId feature);

}  // namespace oriel::rules
