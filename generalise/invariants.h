#pragma once

#include "kernel/model/solid.h"

#include <optional>
#include <string>

namespace oriel {

/// What must not change by generalising.
struct Invariants {
  /// Percent of what it was; missing: it may change.
  std::optional<double> footprint_pct, volume_pct;
  /// Of the highest point.
  std::optional<double> top_m;
};

/// What invariants look at.
struct Measures {
  int lumps = 0;
  double volume_m3 = 0;
  /// The area of facets that look down and lie within half a metre of the lowest point, as seen
  /// from above.
  double footprint_m2 = 0;
  double top_m = 0;
};

Measures measures_of(const Solid& solid);

/// What changed that must not, as a sentence ("the footprint would change by 2.10 %"), or nothing.
/// It must never fall into more pieces than it was.
std::optional<std::string> violation(const Measures& before, const Measures& after,
                                     const Invariants& invariants);

}  // namespace oriel
