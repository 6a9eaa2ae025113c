#pragma once

#include "interpret/learn/search/param_curve.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace oriel {

/// A stretch of values of a param on which an objective has one value.
struct Plateau {
  double from = 0;
  double to = 0;
  double value = 0;
};

/// Neighbouring stretches with one objective are one plateau.
std::vector<Plateau> plateaus_of(std::span<const CurveStretch> stretches,
                                 const std::function<double(const LabelOutcome&)>& objective);

/// A value within the plateau: `kept` if it stands within it, else the number with the fewest
/// decimals in its middle half that is nearest to the middle.
double value_within(const Plateau& plateau, double kept);

}  // namespace oriel
