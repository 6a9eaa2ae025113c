#pragma once

#include "generalise/context.h"
#include "kernel/segment/remove.h"

namespace oriel {

/// Takes off those of the refused features of `remainder` that can go as cells: the solid is put
/// together anew from the cell complex without the cells of protrusions and with those of holes.
/// That needs no cut in the whole building, so pieces of concave parts can go as well. What sits on
/// or in a feature becomes what the feature becomes.
///
/// As many go, taken in halves, as leave a closed solid that is fit by the judge, of no more
/// pieces than it was, that reaches no further than before by more than `unseen_m`, whose footprint
/// changes by no more than what goes covers, in which every feature that is to stay has some
/// surface; if something was refused, or all is judged, and the solid of `remainder` is
/// unfit, that is asked of all features that it has removed, too. Nothing goes by which an
/// invariant is violated. What is valid comes before what is as it came. Returns `remainder` itself
/// if none can go. Never goes what has no cells: features known by a ring only, and imprints.
/// `remainder` must be remove_features() of the same solid. Planes may differ from those of the
/// segmentation by rounding: the solid is solidified anew. Source: paper, section 4 ("cell
/// complex"); docs/generalisation.md.
Remainder remove_cells(const RedrawContext& context, Remainder remainder, double unseen_m = 0);

/// Takes off those of the refused features of `remainder` that are known by a ring only
/// (Feature::is_uncut): a balcony before its loggia is material and air at once, so no cut frees
/// it. The facet that the ring lies in is closed over it, and all surface that hangs on the ring
/// goes: the facet's own plane is the only cut, so the result is closed by construction.
///
/// A ring is left as it is if its surface hangs on anything else (a passage), if a feature that is
/// to stay would lose all its surface, or if what is left is unfit by the judge, where that is
/// given. Where nothing stands in the ring any more, as other steps took it off, it counts as
/// removed. Source: none in the paper; docs/generalisation.md, "Omit".
Remainder fill_rings(const RedrawContext& context, Remainder remainder);

}  // namespace oriel
