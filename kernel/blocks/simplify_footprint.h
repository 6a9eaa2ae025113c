#pragma once

#include "kernel/blocks/blocks.h"
#include "kernel/model/solid.h"
#include "kernel/model/tolerances.h"

#include <optional>

namespace oriel::detail {

/// A body of upright blocks over a simpler footprint.
struct SimplerFootprint {
  Solid solid;
  /// Edges of the footprint that are shorter than was asked for and had to stay.
  int short_edges = 0;
};

/// What blocks() made, one block for each piece of the footprint, over the footprint that
/// simplify_outlines() leaves; each block keeps its height. Nothing if no closed solid comes of it.
std::optional<SimplerFootprint> simplify_footprint(const Solid& solid, const BlockOptions& options,
                                                   const Tolerances& tolerances);

}  // namespace oriel::detail
