#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/missing/rims.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"
#include "model/vec3.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// A rim, or a piece of one closed by a chord, whose points lie in one plane.
struct PlanePiece {
  HoleRim rim;
  Vec3 area;  ///< grid units squared; looks at those for whom the rim runs counter-clockwise
};

/// Cuts rims into plane pieces, all their points within `reach` (grid units) of the plane: a rim
/// that is not plane runs around several missing faces, and where they meet nothing is left but the
/// ends of their common edge. The runs of edges in one plane are cut off one after the other, each
/// by the chord between its ends: first where most speaks for it, that is the length of all edges
/// of holes in its plane, and in that of what lies beyond the chord, whichever is less. A rim of
/// three such runs goes round a corner that was lost with its faces: where their planes meet is a
/// new point of the soup. A piece never folds back on a polygon that lies in its plane. Nothing if
/// a rim has no such run, or is too long, or `work` is used up.
std::optional<std::vector<PlanePiece>> cut_into_plane_pieces(Soup& soup,
                                                             std::span<const PolygonShape> shapes,
                                                             std::vector<HoleRim> rims,
                                                             double reach, Work& work);

}  // namespace oriel::detail
