#pragma once

#include "generalise/invariants/invariants.h"
#include "kernel/model/plan.h"
#include "kernel/segment/remove.h"

namespace oriel {

/// The operator `omit`: features leave the building (paper 5.1, "omission").
///
/// Precondition: the feature's cut can be made again on the solid, and takes no feature along that
/// is to stay; of a building no part of more than half its volume goes: which of two parts is the
/// feature and which the rest is up to the segmentation (under a roof that juts out all around, the
/// walls are a feature of the roof). Touches: the cells of the feature and of all that sits on it;
/// of the rest, the facets of its split planes. Inverse: the solid before, which the caller still
/// has; the removed cells stand in the segmentation. A feature that cannot be omitted is refused
/// with its reason and stays whole. With a judge, features without a cut of their own go as cells
/// (remove_cells).
Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options, const Judge& judge = {});

}  // namespace oriel
