#pragma once

#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/validate.h"

namespace oriel::detail {

/// True if the polygons are one solid of one shell in which validate() finds nothing, and in which
/// no two triangles of a polygon are folded to each other either. Exact. False if that is not so,
/// or not soon seen: then they have to be judged.
///
/// Most that is written is valid, and the proof takes a tenth of the judgement: what lies in a
/// plane exactly need not be cut into triangles, and edges are compared with whole polygons instead
/// of triangles with each other.
bool is_surely_valid_solid(const SnappedBuilding& building, const ValidateOptions& options);

}  // namespace oriel::detail
