#pragma once

#include "kernel/model/solid.h"

#include <vector>

namespace oriel::detail {

/// The point with the least sum of squared distances to `planes`, next to `start` where they leave
/// it free, and no further than `reach` from it: planes of a wall and of a panel in it that are a
/// hair's breadth from parallel meet anywhere. `start` itself if there is none.
Vec3 nearest_point(const std::vector<Plane>& planes, Vec3 start, double reach);

}  // namespace oriel::detail
