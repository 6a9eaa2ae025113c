#pragma once

#include "generalise/generalise.h"
#include "generalise/invariants/fineness.h"
#include "kernel/model/building.h"
#include "kernel/model/description/feature_table.h"

#include <string>
#include <vector>

namespace oriel {

/// What a target asks for: a least length of edges, of those that are new or, `is_everywhere`, of
/// all, and of gaps.
struct Fineness {
  double least_m = 0;
  bool is_everywhere = false;
  /// Why new edges stay that nobody tried to clear; empty: there are none.
  std::string why_not_tried{};
};

/// What of a building that was redrawn as `after` is finer: for each feature with such edges a
/// G415, and everywhere for each with such gaps a G416, warnings. It says if the feature was to
/// change and was refused. Of new edges (new_short_edges) it says why they could not be cleared.
/// Notes are those of features that were refused, which is told already, those that nobody tried to
/// clear (blocks) and, apart from others, those of parts that stay as they were
/// (without_whole_edges).
std::vector<Issue> fineness_issues(const Building& building, const Solid& before,
                                   const Solid& after, const Segmentation& segmentation,
                                   const FeatureTable& table, const Generalised& generalised,
                                   const Fineness& asked);

}  // namespace oriel
