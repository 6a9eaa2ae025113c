#pragma once

#include "kernel/blocks/plan_view.h"
#include "kernel/model/building.h"

#include <vector>

namespace oriel::detail {

/// The boundary of upright blocks as polygons that meet along whole edges, ready for solidify: the
/// tops, the walls between blocks of different height and to the outside, and the ground.
/// `part_of` gives for each region of the view its block, or -1: the outside; `heights_m` the tops
/// of blocks. Blocks that are connected share Polygon::body; those that meet in a point do not.
Building prisms(const PlanView& view, const std::vector<int>& part_of,
                const std::vector<double>& heights_m);

}  // namespace oriel::detail
