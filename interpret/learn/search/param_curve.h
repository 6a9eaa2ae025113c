#pragma once

#include "interpret/learn/label_counter.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel {

/// What labels of a building came to.
struct LabelOutcome {
  /// By label of the set.
  std::vector<ClassCounts> counts;
  double cost = 0;
  friend bool operator==(const LabelOutcome&, const LabelOutcome&) = default;

  void add(const LabelOutcome& other);
  void subtract(const LabelOutcome& other);
};

/// How the outcome of one building depends on one param: a constant between places where labels
/// flip. Places themselves are not asked of: values are chosen between them.
struct ParamCurve {
  struct Part {
    double from = 0;
    LabelOutcome outcome;
  };
  /// The first begins at the low end of the param's range; each has another outcome than that
  /// before it.
  std::vector<Part> pieces;
  /// At the value that the param has.
  LabelOutcome at_value;
};

/// A stretch of values of a param with one outcome of several buildings together.
struct CurveStretch {
  double from = 0;
  double to = 0;
  LabelOutcome sum;
};

/// The curves of several buildings, added up: stretches from low to high, in order.
std::vector<CurveStretch> sum_of(std::span<const ParamCurve* const> curves, double low,
                                 double high);

}  // namespace oriel
