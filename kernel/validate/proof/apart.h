#pragma once

#include "kernel/validate/proof/patches.h"

#include <vector>

namespace oriel::detail {

/// Patches of different polygons have no more in common than corners and edges; `twins` as of
/// twins_of(). False also if that is not known: if too much has to be looked at, which is more
/// than so many times the number of corners.
///
/// What two plane patches have in common ends at an edge of one. So each edge is compared with the
/// patches whose boxes it comes into: it is clear of one that it is an edge of, or that it lies
/// beside, but for an end that is a corner of it. What else is there is compared with the
/// triangles of the patch, and where edges lie in a patch's plane, or two patches have corners in
/// common that no common edges join, all their triangles are compared.
bool are_apart(const SnappedBuilding& building, const ValidateOptions& options,
               const Patches& patches, const PatchCorners& twins);

}  // namespace oriel::detail
