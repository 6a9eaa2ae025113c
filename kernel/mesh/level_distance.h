#pragma once

#include "kernel/model/solid.h"

namespace oriel {

/// The symmetric Hausdorff distance of two forms of one building in m, no further off than
/// `error_m`, as hausdorff_m() measures it, but quick where most facets of one are facets of the
/// other: only points of the others are asked for. Both are in one frame, with the same doubles for
/// the same points; neither is empty.
///
/// Triangles are halved as long as what is known of them allows more than the greatest distance
/// that a point has (Tang et al. 2009): the distance to a triangle is convex, so within another one
/// it is greatest at a corner.
double level_distance_m(const Solid& a, const Solid& b, double error_m = 0.005);

}  // namespace oriel
