#pragma once

#include "interpret/explain/explain.h"
#include "interpret/pack/pack.h"

namespace oriel::rules {

/// Explainer::find_flip.
FlipSearch find_flip(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph,
                     FeatureId feature);

}  // namespace oriel::rules
