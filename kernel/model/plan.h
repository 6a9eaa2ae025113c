#pragma once

#include "kernel/base/ids.h"
#include "kernel/base/issue.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// On the map, the least size that can be seen, and the least distance: the profile `map`'s d and
/// c. What operators go by where the pack does not say `to` or `gap`.
inline constexpr double kToOnMap_m = 0.0005;
inline constexpr double kGapOnMap_m = 0.000125;

/// One decision: what is to be done to one feature at a target scale, and because of what.
struct Step {
  FeatureId feature;
  /// The operator's name ("omit").
  std::string operation;
  /// Id of the pack's entry that asked for it, or of a profile's verdict ("lod:2.0/point").
  std::string rule;
  /// The operator's arguments: lengths in metres and ratios.
  std::map<std::string, double> numbers{};
  std::map<std::string, std::string> words{};
  /// Id of the group of the pack that the entry is for; empty: it is for single features.
  std::string group{};
};

/// The decisions for one building at one scale, in feature order; at most one step a feature.
struct Plan {
  /// The target scale 1 : scale; 0 where a level of detail is the target.
  double scale = 0;
  std::vector<Step> steps;
  std::vector<Issue> issues;
};

}  // namespace oriel
