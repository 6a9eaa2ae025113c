#include "kernel/model/issue.h"
#include "kernel/segment/detail/boundary.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

Boundary boundary_of(const Solid& solid, int lump, World& world) {
  Boundary boundary(world);
  std::map<std::pair<int, int>, int>
      open;  // half-edges that wait for their twin, by (origin, target)
  for (const Shell& shell : solid.shells) {
    if (shell.lump != lump) continue;
    for (const FacetId id : shell.facets) {
      const Facet& facet = solid.facets[id.index()];
      const int f = boundary.add_facet(world.planes.side_of(facet.plane), {id.value});
      for (const Loop& loop : facet.loops) {
        const int first = boundary.half_edge_count();
        const int size = static_cast<int>(loop.size());
        for (const int v : loop) boundary.add_edge(v);
        for (int i = 0; i < size; ++i) {
          const int e = first + i, origin = loop[static_cast<std::size_t>(i)],
                    target = loop[static_cast<std::size_t>((i + 1) % size)];
          boundary.link(e, first + (i + 1) % size);
          const auto twin = open.find({target, origin});
          if (twin == open.end()) {
            if (!open.emplace(std::pair(origin, target), e).second)
              throw GeometryError("an edge runs twice in the same direction");
            continue;
          }
          boundary.pair(e, twin->second);
          open.erase(twin);
        }
        boundary.add_loop(first, f);
      }
    }
  }
  if (!open.empty()) throw GeometryError("a shell is not closed");
  return boundary;
}

}  // namespace oriel::detail
