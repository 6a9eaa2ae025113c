#pragma once

#include "kernel/base/work.h"
#include "model/building.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

namespace oriel::detail {

/// Gives the input polygons that no facet of the solid has (repair left them out) to features.
///
/// A polygon that is parallel to an opening, covers it or a part of it by half of itself at least,
/// and is no further from it than a wall is thick, joins the smallest such opening and what that
/// lies in: their polygons and vertices, their boxes and surfaces. One that lies flat in a facet,
/// within plane_offset_m, becomes an imprint there. The others are left alone, as are those
/// without area, and those that come after `work` is used up.
void join_unassigned_polygons(const Building& building, const Solid& solid,
                              Segmentation& segmentation, const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
