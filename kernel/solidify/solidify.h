#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "model/building.h"
#include "model/repair.h"
#include "model/solid.h"
#include "model/tolerances.h"

namespace oriel {

/// A solid, what was found on the way, and what was done to polygons that were no solid.
struct Solidified : Checked<Solid> {
  RepairReport report;
};

/// Makes a closed, oriented solid with planar facets out of a building's polygons.
///
/// Vertices are welded and rounded to a grid, polygons are clustered into oriented planes, adjacent
/// polygons of one plane become one facet (rings kept: facets are never made from triangles), every
/// shell is oriented outward (cavities inward), and the vertices are put where their planes meet.
/// Polygons come by body. Of a CanonicalOrder the result depends on the geometry alone.
///
/// Polygons that are no closed shell are repaired as `repair` allows: doubles go, vertices are put
/// into the edges they lie on, plane holes are closed, and what bounds the enclosed space on one
/// side only is kept. Facets of such faces alone list no polygons. The report says what was done,
/// and so do E315 (polygons left out), E316 (holes closed), E317 (the rest).
///
/// What is no solid then is rejected: no value, and an error that says why, with val3dity's
/// number:
///   E301 too few polygons (301), E302 shell not closed (302), E303 more than two facets at an edge
///   that do not pair up (303), E307 polygons that cannot be oriented alike (307), E310 a shell
///   without volume, E501 larger than the exact range (4 km at the default weld_m).
/// Warnings and notes: E304 polygons dropped as degenerate after welding, E308 polygons turned
/// round (307), E309 parts thinner than the tolerances that were swallowed.
///
/// After `budget` steps nothing more is repaired and no more polygons are put into common planes; a
/// warning E502 says so.
///
/// Source: the B-rep of the paper's section 3.1; facts and reasons in docs/solidify.md.
Solidified solidify(const Building& building, const Tolerances& tolerances = {},
                    const RepairOptions& repair = {}, std::int64_t budget = kWorkBudget);

/// The same, as a part of work that has a budget of its own; E502 if it is used up.
Solidified solidify(const Building& building, const Tolerances& tolerances,
                    const RepairOptions& repair, Work& work);

}  // namespace oriel
