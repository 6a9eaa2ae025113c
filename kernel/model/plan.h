#pragma once

#include "kernel/model/ids.h"
#include "kernel/model/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// One decision: what is to be done to one feature at a target scale, and because of what.
struct Step {
  FeatureId feature;
  /// The operator's name ("omit").
  std::string operation;
  /// Id of the pack's entry that asked for it.
  std::string rule;
};

/// The decisions for one building at one scale, in feature order; at most one step a feature.
struct Plan {
  /// The target scale 1 : scale.
  double scale = 0;
  std::vector<Step> steps;
  std::vector<Issue> issues;
};

}  // namespace oriel
