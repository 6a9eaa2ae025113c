#pragma once

#include "interpret/pack/rule_base.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"

namespace oriel {

/// Labels the features of one building by the rules of a pack: one verdict for every row of
/// `table`, in their order. A label is a concrete class of the pack, or empty where no rule holds
/// with enough score. Rules run in strata; within one the highest priority wins, then the highest
/// score, then the smallest rule id (docs/rules.md, "Meaning").
///
/// Depends on the table's values and the graph's pairs alone: the same for features in another
/// order. Issues: R260 (note) for every verdict whose margin is below the pack's
/// `decide: ambiguous_below`; R261 (warning) if the pack has `iterate:` and its last
/// round still changed something.
Interpretation interpret(const RuleBase& base, const FeatureTable& table,
                         const FeatureGraph& graph);

}  // namespace oriel
