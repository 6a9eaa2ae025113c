#pragma once

#include "interpret/experiment/learn/learning_set.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// A param whose value stands so close to the flip of labels that a small change moves the
/// objective much.
struct KnifeEdge {
  std::string param;
  std::string unit;
  double value = 0;
  /// The nearest value at which the objective has moved, and how far that is as a share of the
  /// param's range.
  double flip = 0;
  double distance_share = 0;
  /// By how much the objective changes at most within a small change; below 0: it falls.
  double change = 0;
  /// The objects that are found or lost there.
  std::size_t objects = 0;
};

/// What a small change of a param is: so much of its range or of its value, whichever is more.
inline constexpr double kSmallShareOfRange = 0.02;
inline constexpr double kSmallShareOfValue = 0.05;

/// The knife edges of a setting on all samples: params that change the objective by at least
/// `least_change` with a small change, the largest change first.
std::vector<KnifeEdge> knife_edges(const LearningSet& set, const Setting& setting,
                                   double least_change = 0.005);

}  // namespace oriel
