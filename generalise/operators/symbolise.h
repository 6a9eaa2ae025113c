#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// The operator `symbolise`: a template takes the place of a feature, fitted to its size (paper
/// 5.1, "symbolisation").
///
/// `{symbolise: {with: TEMPLATE, to: LENGTH, gap: LENGTH}}`; sides are at least `to` long.
///  - chimney_block: an upright block on the roof with a flat top at the feature's top, its base
///    around the middle of the feature;
///  - dormer_box: a box with an upright front where the feature's was and a flat top at its top,
///    which runs back into the roof;
///  - balcony_box: a slab at the wall at the feature's bottom, as wide and as deep as it, with its
///    volume.
/// Precondition: a protrusion whose roof or wall is found again; the template stands on that one
/// facet alone (not across a ridge). Touches: that facet. New directions: those of the building's
/// walls, up, and for blocks on a sloping roof the direction of its fall. Inverse: omit, and the
/// feature's cells, which the segmentation still has.
detail::Placed symbolise(const Redrawing& task);

}  // namespace oriel
