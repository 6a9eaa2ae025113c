#include "kernel/model/issue.h"
#include "kernel/segment/detail/boundary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
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

Corners::Corners(const Boundary& body)
    : body_(body), is_corner_(static_cast<std::size_t>(body.half_edge_count()), 0) {
  const auto is_kept = [&](int e) -> char& { return is_corner_[static_cast<std::size_t>(e)]; };
  for (int e = 0; e < body.half_edge_count(); ++e)
    if (body.is_alive_edge(e)) is_kept(e) = body.next(body.twin(e)) != body.twin(body.prev(e));
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const int f : body.living_facets())
      for (const int l : body.facet(f).loops) {
        std::vector<int> edges;
        int e = body.loop(l).first;
        do {
          edges.push_back(e);
          e = body.next(e);
        } while (e != body.loop(l).first);
        const auto kept = std::ranges::count_if(edges, [&](int i) { return is_kept(i) != 0; });
        if (kept >= 3 || kept == std::ssize(edges)) continue;
        for (const int i : edges) is_kept(i) = is_kept(body.twin(body.prev(i))) = 1;
        has_changed = true;
      }
  }
}

std::vector<Loop> Corners::loops(int facet) const {
  std::vector<Loop> loops;
  std::size_t outer = 0;
  const auto& numbers = body_.facet(facet).loops;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int first = body_.loop(numbers[i]).first;
    int e = first;
    loops.emplace_back();
    do {
      if (is_corner_[static_cast<std::size_t>(e)]) loops.back().push_back(body_.origin(e));
      e = body_.next(e);
    } while (e != first);
    if (body_.loop(numbers[i]).area > body_.loop(numbers[outer]).area) outer = i;
  }
  std::swap(loops[0], loops[outer]);
  return loops;
}

Side ground_side(const Solid& solid, const PlaneTable& planes, double tilt_deg) {
  const double steepest = -std::cos(tilt_deg * std::numbers::pi / 180);
  Side ground = -1;
  double least = Box::kInfinity;
  for (const Facet& facet : solid.facets) {
    if (solid.planes[facet.plane.index()].normal.z > steepest) continue;
    double lowest = Box::kInfinity;
    for (const int v : facet.loops.front())
      lowest = std::min(lowest, solid.vertices[static_cast<std::size_t>(v)].point.z);
    if (lowest >= least) continue;
    least = lowest;
    ground = planes.side_of(facet.plane);
  }
  return ground;
}

}  // namespace oriel::detail
