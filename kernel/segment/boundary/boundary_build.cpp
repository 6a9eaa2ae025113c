#include "kernel/base/issue.h"
#include "kernel/segment/boundary/boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oriel::detail {

namespace {

/// Pairs the half-edges of a closed boundary by their ends: each waits at its lower vertex for the
/// opposite one.
void pair_twins(Boundary& boundary, int vertices) {
  std::vector<EdgeId> waiting(static_cast<std::size_t>(vertices));  // by lower vertex, a chain
  IndexedVector<EdgeId, EdgeId> behind(static_cast<std::size_t>(boundary.half_edge_count()));
  std::size_t open = 0;
  for (const EdgeId e : boundary.half_edge_ids()) {
    const int from = boundary.origin(e), to = boundary.origin(boundary.next(e));
    EdgeId* place = &waiting[static_cast<std::size_t>(std::min(from, to))];
    while (place->is_valid()) {
      const EdgeId other = *place;
      const int other_from = boundary.origin(other),
                other_to = boundary.origin(boundary.next(other));
      if (other_from == from && other_to == to)
        throw GeometryError("an edge runs twice in the same direction");
      if (other_from == to && other_to == from) break;
      place = &behind[other];
    }
    if (!place->is_valid()) {
      *place = e;
      ++open;
      continue;
    }
    const EdgeId twin = *place;
    *place = behind[twin];
    boundary.pair(e, twin);
    --open;
  }
  if (open > 0) throw GeometryError("a shell is not closed");
}

/// By side: its number in the boundary, if a facet of the lump lies on it. In ascending order, so
/// that each is entered at the end.
std::vector<int> number_sides(const Solid& solid, int lump, Boundary& boundary) {
  const PlaneTable& planes = boundary.world().planes;
  std::vector<int> numbers(2 * static_cast<std::size_t>(planes.size()), -1);
  for (const Shell& shell : solid.shells) {
    if (shell.lump != lump) continue;
    for (const FacetId id : shell.facets)
      numbers[static_cast<std::size_t>(planes.side_of(solid.facets[id.index()].plane))] = 0;
  }
  for (PlaneSide side = 0; side < std::ssize(numbers); ++side)
    if (int& number = numbers[static_cast<std::size_t>(side)]; number == 0)
      number = boundary.number_side(side);
  return numbers;
}

}  // namespace

Boundary boundary_of(const Solid& solid, int lump, World& world) {
  Boundary boundary(world);
  // With room for what the first cuts make: to grow means to copy all.
  constexpr int kRoom = 8;  // one for so many
  const auto with_room = [](std::size_t size) { return static_cast<int>(size + size / kRoom); };
  boundary.reserve(with_room(4 * solid.vertices.size()), with_room(solid.facets.size()));
  const std::vector<int> numbers = number_sides(solid, lump, boundary);
  for (const Shell& shell : solid.shells) {
    if (shell.lump != lump) continue;
    for (const FacetId id : shell.facets) {
      const Facet& facet = solid.facets[id.index()];
      const PlaneSide side = world.planes.side_of(facet.plane);
      const int number = numbers[static_cast<std::size_t>(side)];
      const BodyFacetId f = boundary.add_facet_on(number, side, {id.value}, {});
      for (const Loop& loop : facet.loops) boundary.add_cycle(loop, f);
    }
  }
  pair_twins(boundary, static_cast<int>(solid.vertices.size()));
  return boundary;
}

CornerLoops::CornerLoops(const Boundary& body)
    : body_(body), is_corner_(static_cast<std::size_t>(body.half_edge_count()), 0) {
  for (const EdgeId e : body.half_edge_ids())
    if (body.is_alive_edge(e)) is_corner(e) = body.next(body.twin(e)) != body.twin(body.prev(e));
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const BodyFacetId f : body.facet_ids()) {
      if (!body.is_alive(f)) continue;
      for (const LoopId l : body.facet(f).loops) has_changed |= keep_enough(l);
    }
  }
}

bool CornerLoops::keep_enough(LoopId loop) {
  const EdgeId first = body_.loop(loop).first;
  int size = 0, kept = 0;
  EdgeId e = first;
  do {
    ++size;
    kept += is_corner(e);
    e = body_.next(e);
  } while (e != first);
  if (kept >= 3 || kept == size) return false;
  do {
    is_corner(e) = is_corner(body_.twin(body_.prev(e))) = 1;
    e = body_.next(e);
  } while (e != first);
  return true;
}

std::vector<Loop> CornerLoops::loops(BodyFacetId facet) const {
  std::vector<Loop> loops;
  std::size_t outer = 0;
  const auto& numbers = body_.facet(facet).loops;
  loops.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const EdgeId first = body_.loop(numbers[i]).first;
    EdgeId e = first;
    std::size_t size = 0;
    do {
      size += static_cast<std::size_t>(is_corner_[e]);
      e = body_.next(e);
    } while (e != first);
    loops.emplace_back().reserve(size);
    do {
      if (is_corner_[e]) loops.back().push_back(body_.origin(e));
      e = body_.next(e);
    } while (e != first);
    if (body_.loop(numbers[i]).area > body_.loop(numbers[outer]).area) outer = i;
  }
  std::swap(loops[0], loops[outer]);
  return loops;
}

PlaneSide ground_side(const Solid& solid, const PlaneTable& planes, double tilt_deg) {
  const double steepest = -std::cos(tilt_deg * std::numbers::pi / 180);
  PlaneSide ground = -1;
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
