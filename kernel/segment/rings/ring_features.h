#pragma once

#include "kernel/base/work.h"
#include "model/building.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

namespace oriel {

/// What can be said of a building that stayed open (open_shell): its planes and vertices, a tree of
/// one leaf, and one cell, flagged `open`, that holds all facets and has no volume. Nothing is cut
/// and there are no features yet: add_ring_features and add_imprints find them.
Segmentation segment_open(const Solid& open_shell);

/// Adds the features that only a ring tells of: what lies in an inner ring of a facet is a feature
/// though no cut frees it (docs/segmentation.md, "Ring features"). On a building that stayed open
/// (segment_open) that is every opening; there the inner rings of input polygons count, too (what
/// is flush with them leaves none in the facet), narrow frames around them, and notches in the
/// outline of a facet with something parallel behind them (a door that reaches the ground).
///
/// The feature is the ring's outline and the input polygons behind or before it: those that lie
/// within the outline as seen along the facet's normal, from the facet on inwards and outwards
/// until there is a gap of more than half a metre, at most 4 m. They need not hang together (panes
/// that float in their opening). It has the flag is_uncut, no node, value or quality, no volume;
/// `planes` is the facet's plane, `new_area_m2` the area within the outline. Sense: hole or
/// protrusion as what half of the outline shows (visible_level) lies behind or before the facet;
/// an imprint if it lies in it within plane_offset_m, or if there is nothing.
///
/// A ring that has a feature already (the cap of a feature of the tree fills 0.8 of its rectangle)
/// makes none, and neither does the other side of a wall or frame: a parallel ring with the same
/// outline (0.95 of it) at most half a metre off, behind one that came before it. An outer ring
/// owns what is in it: `host` is the smallest ring feature that has the ring's polygon, else the
/// feature or body that owns the facet; features of the tree whose largest cap lies in the ring are
/// hosted by it, and its box holds theirs.
///
/// Features are appended, the largest ring first, then by its place. `solid` is what `segmentation`
/// was made of. Takes time linear in the polygons and what their rings hold; after `budget` steps
/// no more rings are looked for, and a warning E502 says so.
void add_ring_features(const Building& building, const Solid& solid, Segmentation& segmentation,
                       const Tolerances& tolerances = {}, std::int64_t budget = kWorkBudget);

}  // namespace oriel
