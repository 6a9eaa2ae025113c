#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// A connected area of the plan, z = 0: its outer outline counter-clockwise, then holes clockwise.
using PlanArea = std::vector<Outline>;

/// The union of areas of the plan as connected areas, the largest first. Corners nearer to each
/// other than `reach_m`, or to an edge than half of it, become one, so that cracks and slivers of
/// that width are no more. Holes and areas that are thinner than the reach are left out. None once
/// `work` is used up.
std::vector<PlanArea> united(std::span<const PlanArea> areas, double reach_m, Work& work);

/// What would fill the gap between two areas: for each pair of edges that face each other, no more
/// than `gap_m` apart and with opposite directions (`lean`: sine), the strip between the parts that
/// lie opposite each other. Strips shorter than they are wide are left out: corners that come near
/// each other are no gap.
std::vector<PlanArea> gaps_between(const PlanArea& one, const PlanArea& other, double gap_m,
                                   double lean);

}  // namespace oriel::detail
