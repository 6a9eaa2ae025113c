#pragma once

#include "interpret/explain/what_if.h"

#include <vector>

namespace oriel::rules {

/// The values of one param, within its range, at which something turns that a rule or a relation
/// asks: a condition, or the beginning or end of a ramp.
struct TurningPoints {
  /// Of the feature itself, and of the others, which may change its label by theirs. Ascending,
  /// each once.
  std::vector<double> own, others;
  /// Scores change with it between these values, too.
  bool is_gradual = false;
};

/// The param must have a range. Numbers that are taken from other features' labels (an aggregate of
/// those that are a window) are taken as the labels are with the value that the pack says.
TurningPoints turning_points(WhatIf& what_if, std::size_t param, int row);

}  // namespace oriel::rules
