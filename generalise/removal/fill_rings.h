#pragma once

#include "generalise/invariants/invariants.h"
#include "kernel/model/segmentation.h"
#include "kernel/segment/remove.h"
#include "kernel/segment/segment.h"

namespace oriel {

/// Takes off those of the refused features of `remainder` that only a ring tells of
/// (Feature::is_uncut): a balcony before its loggia is material and air at once, so no cut frees
/// it. The facet that the ring lies in is closed over it, and all surface that hangs on the ring
/// goes: the facet's own plane is the only cut, so the result is closed by construction.
///
/// A ring is left as it is if its surface hangs on anything else (a passage), if a feature that is
/// to stay would lose all its surface, or if what is left is unfit by `validator`, where that is
/// given. Where nothing stands in the ring any more, as other steps took it off, it counts as
/// removed. Source: none in the paper; docs/generalisation.md, "Omit".
Remainder fill_rings(const Segmentation& segmentation, Remainder remainder,
                     const SolidValidator& validator, const SegmentOptions& options = {});

}  // namespace oriel
