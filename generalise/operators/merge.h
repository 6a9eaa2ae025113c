#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// Makes a feature part of its host: its shape stays, but its facets are named by their slope, and
/// it is no object of its own any more. `task.solid` is the solid with the feature still on it.
///
/// Refused if no facet is made of the feature's polygons alone.
detail::Placed merge(const Redrawing& task);

}  // namespace oriel
