#pragma once

#include "kernel/base/ids.h"
#include "model/interpretation.h"
#include "model/segmentation.h"
#include "oriel/result.h"

#include <string>
#include <string_view>

namespace oriel {

/// What a feature is to the building, in a word: "protrusion", "hole", "cavity", and "panel" of an
/// imprint, a flat outline.
std::string_view kind_word(Sense sense);

/// A feature in one plain sentence, from its attributes: "window: a 1.1 × 1.4 m hole in a wall,
/// 0.9 m above the ground, one of a row of four". What is not known is left out. `result` is of the
/// building's segmentation, `interpretation` what a pack said of it.
std::string plain_sentence(const PipelineResult& result, const Interpretation& interpretation,
                           FeatureId feature);

}  // namespace oriel
