#pragma once

#include "generalise/context.h"
#include "generalise/generalised.h"

namespace oriel {

/// Clears what was drawn of new edges that are too short (Invariants::least_edge_m), but for those
/// of parts that stay as they were (without_whole_edges): a facet of three or four corners at such
/// an edge goes (drop_facet), and those beside it are made longer until they meet, as long as fewer
/// edges are too short after that, the solid is as fit by the judge as it was, nothing is violated,
/// and the facet is no place of a feature that stays (StayingFeatures). One facet after the other,
/// those at the first edge first, of these the one with fewer corners first. Without a judge
/// nothing goes. What is left comes as Generalised::uncleared, with the reason why the first of the
/// facets at it could not go. Source: docs/generalisation.md, Fineness.
Generalised clear_edges(const RedrawContext& context, Generalised drawn);

}  // namespace oriel
