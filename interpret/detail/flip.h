#pragma once

#include "interpret/detail/pack.h"
#include "interpret/explain.h"

namespace oriel::rules {

/// Explainer::find_flip.
FlipSearch find_flip(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph,
                     FeatureId feature);

}  // namespace oriel::rules
