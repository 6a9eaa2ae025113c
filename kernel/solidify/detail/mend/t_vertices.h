#pragma once

#include "kernel/solidify/detail/soup.h"

namespace oriel::detail {

/// A soup in which no edge runs past the end of an odd one.
struct SoupWithTVertices {
  Soup soup;
  /// Vertices put into an edge, counted once for each edge.
  int inserted = 0;
};

/// Puts the vertices that lie within `reach` (grid units) of an edge, between its ends, into that
/// edge: of all its polygons. Only the ends of edges with an odd number of polygons are put in:
/// where the numbers are even nothing is missing.
SoupWithTVertices insert_t_vertices(const Soup& soup, double reach);

}  // namespace oriel::detail
