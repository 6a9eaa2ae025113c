#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// The operator `collapse`: a recess, or what sticks out, loses its depth and leaves
/// its outline on its wall or roof as an imprint (paper 5.1; design, "collapse to imprint").
///
/// Precondition: its facet is found again and the outline, the rectangle around it in that facet,
/// lies inside. Touches: that facet, which is split along the outline. Inverse: omit, and the
/// feature's cells, which the segmentation still has.
detail::Placed collapse(const Redrawing& task);

}  // namespace oriel
