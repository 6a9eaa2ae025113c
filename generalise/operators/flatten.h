#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// The operator `flatten`: what is thin and lies flat on its wall or roof goes into it (paper 5.1,
/// Figure 7: a lamina, and a cap that reaches beyond what it lies on).
///
/// What juts out beyond its facet is trimmed. If the rest covers more than half of the facet, the
/// facet takes its place: it moves outwards (of a recess inwards) by the feature's volume over its
/// own area, so that upright on its neighbours the volume is kept. The feature is gone in either
/// case. Precondition: it has depth; if its facet, which may have gone, is to move: it was split
/// off by one plane, no outline that stays is on the facet, and it can move (move_facet). Touches:
/// the facet and those around it. Inverse: the facet moves back, and the feature's cells, which the
/// segmentation still has.
detail::Placed flatten(const Redrawing& task);

}  // namespace oriel
