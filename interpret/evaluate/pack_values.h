#pragma once

#include "interpret/language/expr.h"
#include "interpret/pack/pack.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace oriel::rules {

/// An angle's range, bounds included.
struct AngleRange {
  double low_deg = 0;
  double high_deg = 0;

  friend bool operator==(const AngleRange&, const AngleRange&) = default;
};

/// A range of counts.
struct CountRange {
  /// No most: `1 ..`.
  static constexpr int kNoEnd = std::numeric_limits<int>::max();
  int low = 0;
  int high = kNoEnd;

  friend bool operator==(const CountRange&, const CountRange&) = default;
};

/// What the settings of a pack come to.
struct PackSettings {
  AngleRange wall{75, 105}, roof{0, 75}, ground{105, 180};
  /// A face that looks down is ground if it lies no higher than this over the building's lowest
  /// point.
  double ground_reach_m = 0.5;
  /// Of `decide:`; the evidence is the most that a score is moved by.
  double min_score = 0, ambiguous_below = 0, evidence = 0;

  friend bool operator==(const PackSettings&, const PackSettings&) = default;
};

/// The values of a pack's params, an input of all that is evaluated, and what the pack's settings
/// come to with them. One pack serves all values.
struct PackValues : PackSettings {
  /// Those that the pack states.
  explicit PackValues(const Pack& pack);
  /// Those in `params`, in metres, degrees or plain. Whether they are within their ranges and the
  /// pack is sound with them is not looked at.
  PackValues(const Pack& pack, std::vector<double> params);
  void set(const Pack& pack, std::size_t param, double value);

  /// True if a facet could be two of a wall, a roof and a ground, ends aside.
  [[nodiscard]] bool has_overlapping_hosts() const;
  [[nodiscard]] CountRange count_of(const Pack& pack, const Typical& typical) const;
  /// The inclinations of a kind of facet.
  [[nodiscard]] AngleRange range_of(HostKind kind) const;
  /// What a facet of that inclination is: walls go first.
  [[nodiscard]] HostKind kind_of_facet(double inclination_deg) const;

  std::vector<double> params;

 private:
  void read_settings(const Pack& pack);
};

}  // namespace oriel::rules
