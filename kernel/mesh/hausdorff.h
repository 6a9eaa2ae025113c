#pragma once

#include "kernel/model/solid.h"

namespace oriel {

/// The symmetric Hausdorff distance of two surfaces in m: how far a point of either lies at most
/// from the other surface. No further off than `error_m` (CGAL, bounded error: Tang et al. 2009,
/// refined where a triangle may still hold the maximum). Solids are in one frame; none is empty.
double hausdorff_m(const Solid& a, const Solid& b, double error_m = 0.001);

}  // namespace oriel
