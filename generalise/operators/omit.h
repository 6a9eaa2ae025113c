#pragma once

#include "kernel/model/plan.h"
#include "kernel/segment/remove.h"

namespace oriel {

/// The operator `omit`: features leave the building (paper 5.1, "omission").
///
/// Precondition: the feature's cut can be made again on the solid, and takes no feature along that
/// is to stay. Touches: the cells of the feature and of all that sits on it; of the rest, the
/// facets of its split planes. Inverse: the solid before, which the caller still has; the removed
/// cells stand in the segmentation. A feature that cannot be omitted is refused with its reason and
/// stays whole.
Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options);

}  // namespace oriel
