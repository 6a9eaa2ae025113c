#pragma once

#include "interpret/score/score.h"
#include "model/description/feature_graph.h"
#include "model/vec3.h"

#include <vector>

namespace oriel {

/// A building with the features that rules see, and with what is known to be there: what rules are
/// measured on.
struct Sample {
  DescribedBuilding features;
  /// By row of the table, in the input's coordinates.
  std::vector<Box> boxes;
  /// Of the same building; empty: nothing is known, and whatever is found is wrong.
  std::vector<ExpectedObject> truth;
};

}  // namespace oriel
