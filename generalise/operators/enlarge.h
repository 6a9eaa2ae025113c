#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// The operator `enlarge`: a feature becomes as large as can be seen (paper 5.1, "enlargement"): an
/// opening, or a slab that is too thin.
///
/// `{enlarge: {to: LENGTH, anchor: sill|centre, gap: LENGTH}}`: width and height become at least
/// `to`; the sill stays where it is, or the centre does. Where host margin or neighbours leave no
/// room for all of it, it grows as far as eighths of the way allow. Precondition: a recess or
/// a block that is a box, on a facet that is found again; some growth is possible. Touches: the
/// wall's facet, and the ground's for a door. Depth, directions and the parallel pane stay.
/// Inverse: omit, and the outline that the segmentation still has, sunk in or put on.
detail::Placed enlarge(const Redrawing& task);

}  // namespace oriel
