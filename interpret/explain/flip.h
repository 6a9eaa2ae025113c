#pragma once

#include "interpret/evaluate/pack_values.h"
#include "interpret/explain/explain.h"
#include "interpret/pack/pack.h"

namespace oriel::rules {

/// Explainer::find_flip.
FlipSearch find_flip(const Pack& pack, const PackValues& values, const FeatureTable& table,
                     const FeatureGraph& graph, FeatureId feature, const IsGivenUp& is_given_up);

}  // namespace oriel::rules
