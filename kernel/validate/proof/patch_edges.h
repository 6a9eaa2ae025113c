#pragma once

#include "kernel/validate/proof/patches.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// By corner the one at which the edge from it to the next is run through the other way, in another
/// patch. Nothing unless there is exactly one for each: then every edge is of two patches that are
/// turned alike.
std::optional<PatchCorners> twins_of(const Patches& patches);

/// Around each vertex all corners follow each other by edges.
bool is_one_fan_at_each_vertex(const Patches& patches, const PatchCorners& twins);

/// Edges join all patches.
bool is_one_piece(const Patches& patches, const PatchCorners& twins);

/// The patches, which close, look out of what they enclose.
bool look_outwards(const SnappedBuilding& building, const Patches& patches);

}  // namespace oriel::detail
