#pragma once

#include "kernel/base/work.h"
#include "model/building.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

namespace oriel {

/// Adds the features that no cut can find: openings in the plane of their wall or roof (paper, 6:
/// buildings are given as "boundary representation", and in surveyed ones half of the windows are
/// flush; docs/segmentation.md, "Imprints").
///
/// An imprint is an input polygon, or several, in one facet of the solid, inset in another polygon
/// of it: they fill an inner ring of it, or it runs along three sides of them. Where the hints of
/// polygons differ, connected polygons of one hint count as one. So what tells is how the input was
/// drawn, before planes were clustered. Of what was cut into triangles the rectangles are found
/// that these leave; the triangles of a plain wall have no imprints.
///
/// An imprint has sense imprint, no node, no value and no quality; `planes` is the plane it lies
/// in, `new_area_m2` the area within its outline. `parent` is the feature of the cell on its solid
/// side. Holes and protrusions within its outline are its own (a flush frame with sunk sashes is
/// one window): it is their host, their polygons are its polygons, and its box holds theirs; its
/// volume stays 0. One that has the outline of a recess is no feature beside it: the recess gets
/// its polygons. `host` is the imprint around it, else the feature or body that owns the facet.
///
/// Input polygons that no facet of the solid has, because repair left them out, are looked at too:
/// a pane that floats behind or before an opening joins its feature, one that lies flat on a facet
/// is an imprint there.
///
/// Imprints stand behind the features of the tree, by facet and the largest first (of polygons
/// without facet: last); their outlines are added to `vertices`. Nothing else changes.
/// `segmentation` must be of `solid`, `solid` of `building`. Takes time linear in the polygons of
/// facets that have several; nothing is done where every facet is one polygon. After `budget` steps
/// no more are looked for, and a warning E502 says so.
void add_imprints(const Building& building, const Solid& solid, Segmentation& segmentation,
                  const Tolerances& tolerances = {}, std::int64_t budget = kWorkBudget);

}  // namespace oriel
