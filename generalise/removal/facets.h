#pragma once

#include "model/solid.h"

#include <cstddef>
#include <iterator>
#include <span>
#include <vector>

namespace oriel::detail {

/// Calls `visit(facet, from, to)` with each directed edge of each facet.
template <class Visit>
void for_each_edge(const Solid& solid, const Visit& visit) {
  for (int f = 0; f < std::ssize(solid.facets); ++f)
    for (const Loop& loop : solid.facets[static_cast<std::size_t>(f)].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) visit(f, loop[i], loop[(i + 1) % loop.size()]);
}

/// The plane in doubles of a loop that is not a line: its normal by Newell, through its first
/// vertex.
Plane plane_of(std::span<const Vertex> vertices, const Loop& outer);

/// The shells of facets that hang together by edges. One whose facets look inwards is a cavity; it
/// belongs to the lump with the smallest box around its box, of those that have one.
std::vector<Shell> shells_of(const Solid& solid);

}  // namespace oriel::detail
