#pragma once

#include "kernel/base/numbers.h"
#include "kernel/geometry/exact.h"

#include <span>

namespace oriel::detail {

/// For every point of a sorted list without doubles the first point of its group: pairs closer than
/// `reach` (grid units) are in one group, and so are those that such pairs link.
Numbers group_near_points(std::span<const exact::GridPoint> points, double reach);

}  // namespace oriel::detail
