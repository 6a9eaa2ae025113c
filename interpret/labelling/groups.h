#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/pack.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"

#include <string_view>
#include <vector>

namespace oriel::rules {

/// The groups of the building of `context`, whose memberships are final: for every kind the
/// connected components of the features of its class under its relation, whichever way a pair
/// leads, that have enough members, sorted by id. Pairs of which it is unknown whether they are
/// related do not connect.
std::vector<Group> find_groups(const Pack& pack, const EvaluationContext& context,
                               const FeatureTable& table);

/// gap(members): for every member of a group of `kind` the least distance in metres between two
/// members of its group on one facade, as rectangles in that facade (`along` and `width`,
/// `base_height` and `top`); 0 where two of them meet. NaN for features in no such group, and where
/// a group has no two members on a facade or one of the four attributes is missing of a member.
std::vector<double> group_gaps(std::string_view kind, const FeatureTable& table,
                               const FeatureGraph& graph, const Interpretation& interpretation);

}  // namespace oriel::rules
