#pragma once

#include "generalise/operators/operators.h"

#include <vector>

namespace oriel::detail {

/// Steps of enlarge for openings of one wall plane, and the openings that they push aside.
struct Push {
  std::vector<Step> by;
  /// Steps of displace, with the rule and the gap of what pushes.
  std::vector<Step> pushed;
};

/// What the steps would push: of their Step::openings the recesses that no step is for and that are
/// not `excluded`, where they are nearer than the gap to what grows by all that is asked for, and
/// those next to these in turn. Nothing but the openings is looked at; whether there is room for
/// them is seen when they are put back. By plane, in the order of their first features.
std::vector<Push> pushes_of(const Segmentation& segmentation, const std::vector<Step>& steps,
                            double scale, const std::vector<FeatureId>& excluded);

/// Puts pushed openings back beside what has grown, which is on `task.solid`: as near as the gap,
/// and no nearer to anything else than they were, unless the gap is kept there, too. Their order is
/// kept, rows stay rows, and the sum of the squared shifts is the least there is. Those that cannot
/// be put back, or need not move, are `left`.
Placed push_aside(const Redrawing& task, const std::vector<Step>& by);

}  // namespace oriel::detail
