#pragma once

#include "model/description/feature_graph.h"

namespace oriel::fuzz {

/// A few features for rules to run on: a wing, a window in it, a window without numbers, and what
/// they are to each other.
const DescribedBuilding& scene();

}  // namespace oriel::fuzz
