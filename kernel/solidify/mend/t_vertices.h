#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/soup/soup.h"

namespace oriel::detail {

/// Which vertices are put into the edges that they lie on.
enum class Inserted { odd_ends, all };

/// A soup in which no edge runs past the end of an odd one.
struct SoupWithTVertices {
  Soup soup;
  /// Vertices put into an edge, counted once for each edge.
  int inserted = 0;
};

/// Puts the vertices that lie within `reach` (grid units) of an edge, between its ends, into that
/// edge: of all its polygons. Only the ends of edges with an odd number of polygons are put in, if
/// not all are asked for: where the numbers are even nothing is missing in what was drawn to meet.
/// Once `work`, if given, is used up no more are looked for.
SoupWithTVertices insert_t_vertices(const Soup& soup, double reach,
                                    Inserted inserted = Inserted::odd_ends, Work* work = nullptr);

}  // namespace oriel::detail
