#pragma once

#include "kernel/model/building.h"
#include "kernel/model/description/feature_table.h"
#include "kernel/model/segmentation.h"

namespace oriel::detail {

/// Sets the ids of all features: 64 bits of what they are, which do not depend on the order of the
/// input.
void name_features(FeatureTable& table, const Building& building, const Segmentation& segmentation);

}  // namespace oriel::detail
