#pragma once

#include "generalise/generalise.h"
#include "kernel/model/interpretation.h"
#include "kernel/model/segmentation.h"

#include <vector>

namespace oriel {

/// Adds to `redrawn` what is known of the features that are gone: how many of each label, and on
/// the building the flat attributes `oriel_removed_LABEL` and `oriel_removed_volume_m3`.
void count_removed(const std::vector<FeatureId>& removed, const Segmentation& segmentation,
                   const Interpretation& interpretation, Redrawn& redrawn);

}  // namespace oriel
