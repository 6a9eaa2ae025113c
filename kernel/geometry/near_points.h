#pragma once

#include "kernel/base/text/numbers.h"
#include "kernel/geometry/exact.h"
#include "model/whole_point.h"

#include <functional>
#include <span>

namespace oriel {

/// For every point of a sorted list without doubles the first point of its group: pairs closer than
/// `reach` (in the unit of the points) are in one group, and so are those that such pairs link.
/// With `is_pair` only pairs for which that is true.
Numbers group_near_points(std::span<const exact::GridPoint> points, double reach);
Numbers group_near_points(std::span<const MicrometrePoint> points, double reach,
                          const std::function<bool(int, int)>& is_pair = {});

}  // namespace oriel
