#pragma once

#include "kernel/base/ids.h"
#include "kernel/base/issue.h"
#include "kernel/base/name.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

/// What the rules say of one feature.
struct Verdict {
  FeatureId feature;
  /// A concrete class of the pack, or empty: unknown.
  Name label;
  /// 0…1, the winning rule's; 0 for unknown.
  double score = 0;
  /// Score of the winner minus that of the best rule for another label at the same priority; the
  /// score itself where there is none.
  double margin = 0;
  /// Id of the rule that won, or empty.
  Name rule;
  /// The label that came second, or empty.
  Name runner_up;
};

/// Features that belong together: a component of one of the pack's `groups:`.
struct Group {
  /// The kind and the smallest id of its members: `window_row.f11yv1hbtweapa`.
  std::string id;
  /// Its name in the pack.
  std::string kind;
  /// In feature order.
  std::vector<FeatureId> members;
};

/// The verdicts of one building, one per feature in feature order.
struct Interpretation {
  std::vector<Verdict> verdicts;
  /// In the order of the pack, then by id.
  std::vector<Group> groups;
  std::vector<Issue> issues;
};

/// By feature: the ids of the groups it is in, in their order.
std::vector<std::vector<std::string>> groups_by_feature(const Interpretation& interpretation);

/// By feature: what it is a part of, as the panes of a window are. That is the first feature with a
/// label among its host (by feature, invalid: the body), the host's host, and so on; invalid where
/// there is none, and for features that have a label themselves.
std::vector<FeatureId> wholes_by_feature(const Interpretation& interpretation,
                                         std::span<const FeatureId> hosts);

}  // namespace oriel
