#pragma once

#include "kernel/base/ids.h"

#include <string>
#include <vector>

namespace oriel {

/// A change that would let a refused operator act.
struct Need {
  /// What would have to be less: "gap" or "to", an argument of the operator, in metres; "ratio",
  /// the share that stays; "count", how many features there are.
  std::string what;
  /// By how much.
  double less = 0;
  /// What it would be then: in metres, a share, or a count.
  double then = 0;
};

/// What stands in the way of an operator that was refused, as far as it is known.
struct Hindrance {
  /// Each would do by itself; those of the least change first.
  std::vector<Need> needs{};
  /// Features that it would come too near to.
  std::vector<FeatureId> beside{};
};

}  // namespace oriel
