#pragma once

#include "kernel/segment/cuts/patch.h"

#include <vector>

namespace oriel::detail {

/// Adds protrusions that stand across the meeting of two planes and are flush with a facet: a
/// chimney astride a ridge in the plane of the gable. The facet belongs to the part and to the rest
/// and is split where the two planes meet it: along the edges that it has there with the rest, up
/// to where these meet inside it.
void add_flush_patches(FlatBody& body, const PatchOptions& options, std::vector<Patch>& patches);

}  // namespace oriel::detail
