#pragma once

#include "kernel/segment/complex/chord.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <utility>
#include <vector>

namespace oriel::detail {

/// An undirected edge, a < b. Its windings say for each label how many times more it holds to the
/// left of a → b than to the right; none is 0, and there is one at least.
struct PlanarEdge {
  int a = -1;
  int b = -1;
  std::vector<std::pair<int, int>> windings;
};

/// Cuts the chords of one plane until no two edges cross, overlap or pass nearer to a vertex than
/// half the pool's reach: then what is left and right of an edge is certain in doubles. Where
/// chords cross the pool gets a vertex, unless one is within reach.
///
/// Ends: a chord is only ever replaced by shorter ones, and a vertex is made only where it shortens
/// both chords that cross; where they cross at their ends both stay whole. What closed outlines
/// were before are closed outlines after.
std::vector<PlanarEdge> refine(std::vector<Chord> chords, const PlaneAxes& axes, VertexPool& pool);

}  // namespace oriel::detail
