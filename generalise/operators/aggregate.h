#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// True of `{aggregate: {into: block}}`, which is for single features.
bool becomes_block(const Step& step);

/// The operator `aggregate`: the openings of one storey on one facade become a strip (paper 5.1,
/// "aggregation").
///
/// `{aggregate: {into: block}}` is for a slab with its parapet: the box around the feature and all
/// that sits on it takes their place. `{aggregate: {into: strip, gap: LENGTH}}`: the strip is one
/// recess as wide as all of them together from the first to the last, with the area of all of them
/// (so it is lower), about the middle of their heights, and with their mean depth. It stands for
/// the first of them along the wall; the others are gone. Precondition: at least two recesses that
/// are boxes, of one class, storey and facet; nothing else lies in the strip's way. Touches: the
/// wall's facet. Inverse: omit, and the recesses that the segmentation still has.
detail::Placed aggregate(const Redrawing& task);

}  // namespace oriel
