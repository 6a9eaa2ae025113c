#pragma once

#include "kernel/model/ids.h"
#include "kernel/model/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// What the rules say of one feature.
struct Verdict {
  FeatureId feature;
  /// A concrete class of the pack, or empty: unknown.
  std::string label;
  /// 0…1, the winning rule's; 0 for unknown.
  double score = 0;
  /// Score of the winner minus that of the best rule for another label at the same priority; the
  /// score itself where there is none.
  double margin = 0;
  /// Id of the rule that won, or empty.
  std::string rule;
  /// The label that came second, or empty.
  std::string runner_up;
};

/// The verdicts of one building, one per feature in feature order.
struct Interpretation {
  std::vector<Verdict> verdicts;
  std::vector<Issue> issues;
};

}  // namespace oriel
