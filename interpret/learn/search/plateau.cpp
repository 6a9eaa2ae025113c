#include "interpret/learn/search/plateau.h"

#include <cmath>

namespace oriel {

namespace {

/// Objectives that differ by less are one.
constexpr double kSameObjective = 1e-12;
constexpr int kMostDecimalsOfValue = 9;

}  // namespace

std::vector<Plateau> plateaus_of(std::span<const CurveStretch> stretches,
                                 const std::function<double(const LabelOutcome&)>& objective) {
  std::vector<Plateau> plateaus;
  for (const CurveStretch& stretch : stretches) {
    const double value = objective(stretch.sum);
    if (!plateaus.empty() && std::abs(plateaus.back().value - value) <= kSameObjective)
      plateaus.back().to = stretch.to;
    else
      plateaus.push_back({stretch.from, stretch.to, value});
  }
  return plateaus;
}

double value_within(const Plateau& plateau, double kept) {
  if (kept > plateau.from && kept < plateau.to) return kept;
  const double middle = plateau.from + (plateau.to - plateau.from) / 2;
  const double reach = (plateau.to - plateau.from) / 4;
  double unit = 1;
  for (int decimals = 0; decimals <= kMostDecimalsOfValue; ++decimals, unit *= 10)
    if (const double rounded = std::round(middle * unit) / unit;
        std::abs(rounded - middle) <= reach)
      return rounded;
  return middle;
}

}  // namespace oriel
