#include "kernel/segment/boundary/parting.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace oriel::detail {

void FacetCopier::add(std::span<const BodyFacetId> facets) {
  scratch_.copy_of.start(from_.half_edge_count());
  int edges = 0;
  for (const BodyFacetId f : facets) from_.for_each_edge(f, [&](EdgeId) { ++edges; });
  to_.reserve(2 * edges, static_cast<int>(facets.size()) + 2);
  for (const BodyFacetId f : facets) add(f);
}

void FacetCopier::add(BodyFacetId f) {
  const auto& facet = from_.facet(f);
  const BodyFacetId copy =
      to_.add_facet(is_turned_ ? facet.side ^ 1 : facet.side, facet.sources, facet.marks);
  for (const LoopId l : facet.loops) {
    origins_.clear();
    pairs_.clear();
    EdgeId one{to_.half_edge_count()};
    const EdgeId first = from_.loop(l).first;
    EdgeId e = first;
    do {
      origins_.push_back(is_turned_ ? from_.target(e) : from_.origin(e));
      scratch_.copy_of.set(e, one);
      // Whichever side comes last is paired.
      if (const EdgeId twin = copy_of(from_.twin(e)); twin.is_valid())
        pairs_.emplace_back(one, twin);
      ++one.value;
      e = from_.next(e);
    } while (e != first);
    to_.add_cycle(origins_, copy, is_turned_);
    for (const auto& [one_side, other] : pairs_) to_.pair(one_side, other);
  }
}

namespace {

/// Adds the facets that hang together with `start` and are not in `seen` yet.
void add_piece(const Boundary& body, BodyFacetId start, StampSet<BodyFacetId>& seen,
               std::vector<BodyFacetId>& piece) {
  seen.insert(start);
  piece.push_back(start);
  for (std::size_t i = 0; i < piece.size(); ++i)
    body.for_each_edge(piece[i], [&](EdgeId e) {
      const BodyFacetId g = body.facet_of(body.twin(e));
      if (seen.insert(g)) piece.push_back(g);
    });
}

/// The living facets in connected pieces, in the order of their first facets.
std::vector<std::vector<BodyFacetId>> pieces_of(const Boundary& body) {
  std::vector<std::vector<BodyFacetId>> pieces;
  StampSet<BodyFacetId>& seen = body.world().scratch.facets_of_piece;
  seen.start(body.facet_count());
  for (const BodyFacetId start : body.facet_ids()) {
    if (!body.is_alive(start) || seen.contains(start)) continue;
    add_piece(body, start, seen, pieces.emplace_back());
    std::ranges::sort(pieces.back());
  }
  return pieces;
}

double volume_of(const Boundary& body, std::span<const BodyFacetId> facets) {
  double sum = 0;
  for (const BodyFacetId f : facets)
    sum += body.world().planes.offset_m(body.facet(f).side) * body.area(f);
  return sum / 3;
}

/// How often the facets wind around a point: 1 inside, 0 outside.
double winding_number(const Boundary& body, std::span<const BodyFacetId> facets, Vec3 eye) {
  double sum = 0;
  for (const BodyFacetId f : facets) sum += winding_part(body.outlines(f), eye);
  return sum;
}

Boundary copy_facets(const Boundary& body, std::span<const BodyFacetId> facets, bool is_turned) {
  FacetCopier copier(body, is_turned);
  copier.add(facets);
  return std::move(copier.boundary());
}

}  // namespace

bool is_connected(const Boundary& body) {
  StampSet<BodyFacetId>& seen = body.world().scratch.facets_of_piece;
  seen.start(body.facet_count());
  std::vector<BodyFacetId> piece;
  for (const BodyFacetId f : body.facet_ids()) {
    if (!body.is_alive(f) || seen.contains(f)) continue;
    if (!piece.empty()) return false;
    add_piece(body, f, seen, piece);
  }
  return true;
}

Boundary compacted(const Boundary& body) { return copy_facets(body, body.living_facets(), false); }

std::vector<Boundary> part_into_lumps(const Boundary& body) {
  std::vector<Boundary> lumps;
  std::vector<std::vector<BodyFacetId>> outers, cavities;
  for (const auto& piece : pieces_of(body))
    (volume_of(body, piece) > 0 ? outers : cavities).push_back(piece);
  std::vector<std::vector<BodyFacetId>> all = outers;
  for (const auto& cavity : cavities) {
    const Vec3 eye = body.at(body.loop(body.facet(cavity[0]).loops[0]).first);
    for (std::size_t i = 0; i < outers.size(); ++i)
      if (winding_number(body, outers[i], eye) > 0.5) {
        all[i].insert(all[i].end(), cavity.begin(), cavity.end());
        break;
      }
  }
  for (const auto& facets : all) lumps.push_back(copy_facets(body, facets, false));
  return lumps;
}

std::vector<Boundary> take_out_cavities(Boundary& body) {
  std::vector<Boundary> cavities;
  if (is_connected(body)) return cavities;
  const auto pieces = pieces_of(body);
  for (const auto& piece : pieces) {
    if (volume_of(body, piece) > 0) continue;
    cavities.push_back(copy_facets(body, piece, true));
    body.remove(piece);
  }
  return cavities;
}

bool fill_cavity(Boundary& body, const Box& box) {
  for (const auto& piece : pieces_of(body)) {
    Box around;
    for (const BodyFacetId f : piece)
      body.for_each_edge(f, [&](EdgeId e) { around.grow(body.at(e)); });
    if (volume_of(body, piece) >= 0 || around != box) continue;
    body.remove(piece);
    return true;
  }
  return false;
}

Solid solid_of(const std::vector<Boundary>& bodies, const Solid& original,
               const std::set<int>& gone) {
  Solid solid;
  solid.grid_m = original.grid_m;
  solid.planes = original.planes;
  std::map<int, int> number;
  const auto vertex = [&](const World& world, int point) {
    const auto [entry, is_new] = number.emplace(point, static_cast<int>(solid.vertices.size()));
    if (is_new) solid.vertices.push_back({world.points.at(point), world.points.is_meeting(point)});
    return entry->second;
  };
  // A cap may lie in a plane that the original has in the other orientation only.
  std::map<PlaneSide, PlaneId> turned;
  const auto plane = [&](const World& world, PlaneSide side) {
    if (const PlaneId id = world.planes.id_of(side); id.is_valid()) return id;
    const auto [entry, is_new] =
        turned.emplace(side, PlaneId{static_cast<int>(solid.planes.size())});
    if (is_new) {
      const Plane& given = world.planes.plane(side >> 1);
      solid.planes.push_back((side & 1) != 0 ? exact::opposite(given) : given);
    }
    return entry->second;
  };
  int lump = 0;
  for (const Boundary& body : bodies)
    for (const Boundary& part : part_into_lumps(body)) {
      const CornerLoops corners(part);
      for (const auto& piece : pieces_of(part)) {
        Shell shell{{}, lump, volume_of(part, piece) < 0};
        for (const BodyFacetId f : piece) {
          Facet facet{plane(part.world(), part.facet(f).side), corners.loops(f), {}};
          for (Loop& loop : facet.loops)
            for (int& v : loop) v = vertex(part.world(), v);
          for (const int source : part.facet(f).sources)
            for (const int polygon : original.facets[at(source)].polygons)
              if (!gone.contains(polygon)) facet.polygons.push_back(polygon);
          std::ranges::sort(facet.polygons);
          shell.facets.push_back(FacetId{static_cast<int>(solid.facets.size())});
          solid.facets.push_back(std::move(facet));
        }
        solid.shells.push_back(std::move(shell));
      }
      ++lump;
    }
  std::ranges::stable_sort(solid.shells, {},
                           [](const Shell& s) { return std::pair(s.lump, s.is_cavity); });
  return solid;
}

namespace {

/// The bits of a number stirred, one to one (the finaliser of SplitMix64).
std::uint64_t mixed(std::uint64_t number) {
  number = (number ^ number >> 30U) * 0xbf58476d1ce4e5b9U;
  number = (number ^ number >> 27U) * 0x94d049bb133111ebU;
  return number ^ number >> 31U;
}

}  // namespace

BodyState state_of(const Boundary& body) {
  constexpr double kPerSquareMetre = 1e6;
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U;  // spreads neighbouring numbers
  BodyState state{};
  for (const BodyFacetId f : body.facet_ids()) {
    if (!body.is_alive(f)) continue;
    const auto side = static_cast<std::uint64_t>(body.facet(f).side);
    const auto area = static_cast<std::uint64_t>(std::llround(body.area(f) * kPerSquareMetre));
    const std::uint64_t facet = mixed(mixed(side * kOdd) + area);
    state[0] += facet;
    state[1] += mixed(facet + kOdd);
  }
  return state;
}

bool is_mostly_dead(const Boundary& body) {
  constexpr int kTimes = 16;  // so often the body is copied no more than it has lost
  constexpr int kFew = 64;    // half-edges that cost nothing
  const int all = body.half_edge_count(), living = all - body.dead_edge_count();
  return all > kFew && all > kTimes * living;
}

bool is_convex(const Boundary& body, EdgeId& bend) {
  const int size = body.half_edge_count(), start = bend.is_valid() ? bend.value : 0;
  for (int i = 0; i < size; ++i) {
    bend = EdgeId{start + i < size ? start + i : start + i - size};
    if (body.is_alive_edge(bend) && bend < body.twin(bend) && body.is_reflex(bend)) return false;
  }
  return true;
}

}  // namespace oriel::detail
