#pragma once

#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <vector>

namespace oriel::detail {

/// A half-edge of an edge group as seen along the edge.
struct Spoke {
  int half_edge = -1;
  /// It runs from the smaller point to the larger one: going round the edge counter-clockwise (the
  /// larger point towards the eye), the polygon's front comes behind it.
  bool runs_up = false;
};

/// The half-edges of one edge counter-clockwise round it, by where their polygons lie. Decided
/// exactly on the polygons' integer normals. Of polygons that lie the same way, those in front (as
/// seen from the side that the lexicographically larger one of their normals points to) come in the
/// order of their numbers whichever edge is looked at, so that the order of two such polygons is
/// the same at all their edges. Polygons without area count as lying along the first one.
std::vector<Spoke> sort_round(const Soup& soup, const ShellMesh& mesh, const EdgeGroup& group,
                              const std::vector<PolygonShape>& shapes);

}  // namespace oriel::detail
