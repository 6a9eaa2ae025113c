#pragma once

#include "kernel/model/description/feature_graph.h"
#include "kernel/model/description/feature_table.h"
#include "kernel/model/interpretation.h"

#include <string_view>
#include <vector>

namespace oriel::rules {

/// gap(members): for every member of a group of `kind` the least distance in metres between two
/// members of its group on one facade, as rectangles in that facade (`along` and `width`,
/// `base_height` and `top`); 0 where two of them meet. NaN for features in no such group, and where
/// a group has no two members on a facade or one of the four attributes is missing of a member.
std::vector<double> group_gaps(std::string_view kind, const FeatureTable& table,
                               const FeatureGraph& graph, const Interpretation& interpretation);

}  // namespace oriel::rules
