#pragma once

#include "interpret/pack/rule_base.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"
#include "model/plan.h"

#include <vector>

namespace oriel {

/// What the pack's `generalise:` entries ask for at the scale 1 : scale_denominator. For every
/// feature the first entry, in the pack's order, whose scales, class and condition fit decides; a
/// condition that is unknown does not fit. Features that no entry fits have no step.
/// `interpretation` must be of this table; what it calls a feature is what `is CLASS` reads.
/// Throws InputError (R250) if the denominator is not a number of at least 1.
Plan plan(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
          const Interpretation& interpretation, double scale_denominator);

/// The denominators at which entries of the pack begin or end, ascending.
std::vector<double> plan_bounds(const RuleBase& base);

}  // namespace oriel
