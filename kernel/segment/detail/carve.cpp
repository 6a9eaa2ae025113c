#include "kernel/segment/detail/carve.h"

#include "kernel/geometry/exact.h"
#include "kernel/model/issue.h"
#include "kernel/segment/detail/number_map.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Copies facets with their half-edges into a boundary of their own. Turned round, air becomes a
/// body. Only one copier at a time may be in use.
class Copier {
 public:
  Copier(const Boundary& from, bool is_turned)
      : from_(from), to_(from.world()), scratch_(from.world().scratch), is_turned_(is_turned) {}

  void add(const std::vector<int>& facets) {
    scratch_.copied_edges.start(from_.half_edge_count());
    if (std::ssize(scratch_.copy_of) < from_.half_edge_count())
      scratch_.copy_of.resize(at(from_.half_edge_count()));
    int edges = 0;
    for (const int f : facets) from_.for_each_edge(f, [&](int) { ++edges; });
    to_.reserve(2 * edges, static_cast<int>(facets.size()) + 2);
    for (const int f : facets) add(f);
    for (const int f : facets) pair_twins(f);
  }

  [[nodiscard]] int copy_of(int e) const { return scratch_.copy_of[at(e)]; }
  Boundary& boundary() { return to_; }

 private:
  void add(int f) {
    const auto& facet = from_.facet(f);
    const int copy =
        to_.add_facet(is_turned_ ? facet.side ^ 1 : facet.side, facet.sources, facet.marks);
    for (const int l : facet.loops) {
      const int first = from_.loop(l).first;
      int e = first, last = -1;
      do {
        const int one = to_.add_edge(is_turned_ ? from_.target(e) : from_.origin(e));
        if (last >= 0) link(last, one);
        scratch_.copied_edges.insert(e);
        scratch_.copy_of[at(e)] = last = one;
        e = from_.next(e);
      } while (e != first);
      link(last, copy_of(first));
      to_.add_loop(copy_of(first), copy);
    }
  }

  void link(int e, int after) { is_turned_ ? to_.link(after, e) : to_.link(e, after); }

  /// Pairs the copies of edges whose two sides are both copied.
  void pair_twins(int f) {
    from_.for_each_edge(f, [&](int e) {
      const int twin = from_.twin(e);
      if (e < twin && scratch_.copied_edges.contains(twin)) to_.pair(copy_of(e), copy_of(twin));
    });
  }

  const Boundary& from_;
  Boundary to_;
  Scratch& scratch_;
  bool is_turned_;
};

class Remover {
 public:
  Remover(Boundary& body, const std::vector<Cap>& caps, bool is_hole)
      : body_(body), caps_(caps), is_hole_(is_hole), copier_(body, is_hole) {
    for (const Cap& cap : caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges)
          if (edge.rim >= 0) twin_of_rim_.emplace_back(edge.rim, body.twin(edge.rim));
    std::ranges::sort(twin_of_rim_);
    find_lump();
  }

  Carved run(FeatureId mark, std::vector<int> touched) {
    copier_.add(facets_);
    close_lump();
    for (const int f : facets_)
      body_.for_each_edge(f, [&](int e) { touched.push_back(body_.origin(e)); });
    for (const Cap& cap : caps_)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges) touched.push_back(edge.from);
    body_.remove(facets_);
    close_rest(mark);
    return {std::move(copier_.boundary()), cap_point_, std::move(touched)};
  }

 private:
  [[nodiscard]] bool is_rim(int e) const { return find_in(twin_of_rim_, e).has_value(); }

  /// The facets inside the rims, ascending.
  void find_lump() {
    StampSet& seen = body_.world().scratch.facets_of_lump;
    seen.start(body_.facet_count());
    const auto push = [&](int f) {
      if (seen.insert(f)) facets_.push_back(f);
    };
    for (const auto& [rim, twin] : twin_of_rim_) push(body_.facet_of(rim));
    for (std::size_t i = 0; i < facets_.size(); ++i)
      body_.for_each_edge(facets_[i], [&](int e) {
        if (is_rim(e)) return;
        if (is_rim(body_.twin(e))) throw GeometryError("the rim of a cut does not separate a lump");
        push(body_.facet_of(body_.twin(e)));
      });
    std::ranges::sort(facets_);
  }

  /// A free edge that waits for its other side.
  struct Open {
    int from, to, edge;
  };

  /// Half-edges of a cap, linked loop by loop into a facet. Free edges wait in `free` for their
  /// other side; those of the rim are added to `of_rim`.
  static int add_cap(Boundary& boundary, const Cap& cap, Side side, bool is_backward,
                     std::vector<Open>& free, NumberMap& of_rim) {
    const int f = boundary.add_facet(side);
    for (const CapLoop& loop : cap.loops) {
      int first = -1, last = -1;
      for (const CapEdge& edge : loop.edges) {
        const int from = is_backward ? edge.to : edge.from, to = is_backward ? edge.from : edge.to;
        const int e = boundary.add_edge(from);
        if (first < 0)
          first = e;
        else
          is_backward ? boundary.link(e, last) : boundary.link(last, e);
        last = e;
        if (edge.rim >= 0)
          of_rim.emplace_back(edge.rim, e);
        else
          pair_free(boundary, {from, to, e}, free);
      }
      is_backward ? boundary.link(first, last) : boundary.link(last, first);
      boundary.add_loop(is_backward ? last : first, f);
    }
    return f;
  }

  static void pair_free(Boundary& boundary, const Open& open, std::vector<Open>& free) {
    const auto other = std::ranges::find_if(
        free, [&](const Open& o) { return o.from == open.to && o.to == open.from; });
    if (other != free.end())
      boundary.pair(open.edge, other->edge);
    else
      free.push_back(open);
  }

  /// A protrusion's own caps look back at the rest; the air of a hole ends where the rest is
  /// closed.
  void close_lump() {
    Boundary& lump = copier_.boundary();
    std::vector<Open> free;
    NumberMap of_rim;
    for (const Cap& cap : caps_) {
      const int f = add_cap(lump, cap, is_hole_ ? cap.side : cap.side ^ 1, !is_hole_, free, of_rim);
      for (const int g : cap.covered) {
        for (const CapMark& mark : body_.facet(g).marks) lump.add_mark(f, mark);
        lump.add_sources(f, body_.facet(g).sources);
      }
      if (cap.is_taken) lump.add_sources(f, body_.facet(facet_beyond(cap)).sources);
      cap_facets_.push_back(f);
    }
    for (const auto& [rim, e] : of_rim) lump.pair(e, copier_.copy_of(rim));
    // Caps that lie in one plane side by side are one facet; so are the pieces of a facet on both
    // sides of a cut that has only touched it.
    for (const int f : cap_facets_)
      if (lump.is_alive(f)) lump.heal(f);
  }

  void close_rest(FeatureId mark) {
    std::vector<Open> free;
    NumberMap of_rim;
    std::vector<int> facets;
    for (const Cap& cap : caps_)
      facets.push_back(add_cap(body_, cap, cap.side, false, free, of_rim));
    std::ranges::sort(of_rim);
    for (const auto& [rim, e] : of_rim) {
      const int beyond = *find_in(twin_of_rim_, rim);
      body_.pair(e, find_in(of_rim, beyond).value_or(beyond));
    }
    for (std::size_t i = 0; i < caps_.size(); ++i) {
      for (const int g : caps_[i].covered) body_.cover(facets[i], g);
      if (!caps_[i].covered.empty()) body_.zip(facets[i]);
    }
    leave_mark(facets, mark);
    for (std::size_t i = 0; i < caps_.size(); ++i) {
      int f = facets[i];
      if (caps_[i].is_taken) {
        const int ground = facet_beyond(caps_[i]);
        body_.cover(ground, f);
        f = ground;
      }
      if (body_.is_alive(f)) body_.heal(f);
    }
  }

  /// The facet beyond the rim of a cap.
  [[nodiscard]] int facet_beyond(const Cap& cap) const {
    for (const CapLoop& loop : cap.loops)
      for (const CapEdge& edge : loop.edges)
        if (edge.rim >= 0) return body_.facet_of(*find_in(twin_of_rim_, edge.rim));
    throw GeometryError("a cap without a rim");
  }

  void leave_mark(const std::vector<int>& facets, FeatureId mark) {
    int largest = -1;
    for (std::size_t i = 0; i < facets.size(); ++i)
      if (!caps_[i].is_taken && (largest < 0 || body_.area(facets[i]) > body_.area(largest)))
        largest = facets[i];
    const auto shape = body_.outlines(largest);
    const Side side = body_.facet(largest).side;
    const Vec3 normal = body_.world().planes.normal(side);
    if (const auto inside = interior_point(shape, normal)) {
      // The first vertex of the outline may lie on its plane by decree only.
      const double off = dot(normal, *inside) - body_.world().planes.offset_m(side);
      cap_point_ = *inside - off * normal;
      body_.add_mark(largest, {mark, cap_point_});
    }
  }

  Boundary& body_;
  const std::vector<Cap>& caps_;
  bool is_hole_;
  Copier copier_;
  NumberMap twin_of_rim_;    ///< as they were before the cut, sorted
  std::vector<int> facets_;  ///< of the lump
  std::vector<int> cap_facets_;
  Vec3 cap_point_;
};

/// Adds the facets that hang together with `start` and are not in `seen` yet.
void add_piece(const Boundary& body, int start, StampSet& seen, std::vector<int>& piece) {
  seen.insert(start);
  piece.push_back(start);
  for (std::size_t i = 0; i < piece.size(); ++i)
    body.for_each_edge(piece[i], [&](int e) {
      const int g = body.facet_of(body.twin(e));
      if (seen.insert(g)) piece.push_back(g);
    });
}

/// The living facets in connected pieces, in the order of their first facets.
std::vector<std::vector<int>> pieces_of(const Boundary& body) {
  std::vector<std::vector<int>> pieces;
  StampSet& seen = body.world().scratch.facets_of_piece;
  seen.start(body.facet_count());
  for (int start = 0; start < body.facet_count(); ++start) {
    if (!body.is_alive(start) || seen.contains(start)) continue;
    add_piece(body, start, seen, pieces.emplace_back());
    std::ranges::sort(pieces.back());
  }
  return pieces;
}

double volume_of(const Boundary& body, const std::vector<int>& facets) {
  double sum = 0;
  for (const int f : facets) sum += body.world().planes.offset_m(body.facet(f).side) * body.area(f);
  return sum / 3;
}

/// How often the facets wind around a point: 1 inside, 0 outside.
double winding_number(const Boundary& body, const std::vector<int>& facets, Vec3 eye) {
  double sum = 0;
  for (const int f : facets) sum += winding_part(body.outlines(f), eye);
  return sum;
}

Boundary copy_facets(const Boundary& body, const std::vector<int>& facets, bool is_turned) {
  Copier copier(body, is_turned);
  copier.add(facets);
  return std::move(copier.boundary());
}

}  // namespace

Carved take_off(Boundary& body, const std::vector<Cap>& caps, bool is_hole, FeatureId mark,
                std::vector<int> touched) {
  return Remover(body, caps, is_hole).run(mark, std::move(touched));
}

bool is_connected(const Boundary& body) {
  StampSet& seen = body.world().scratch.facets_of_piece;
  seen.start(body.facet_count());
  std::vector<int> piece;
  for (int f = 0; f < body.facet_count(); ++f) {
    if (!body.is_alive(f) || seen.contains(f)) continue;
    if (!piece.empty()) return false;
    add_piece(body, f, seen, piece);
  }
  return true;
}

Boundary compacted(const Boundary& body) { return copy_facets(body, body.living_facets(), false); }

std::vector<Boundary> part_into_lumps(const Boundary& body) {
  std::vector<Boundary> lumps;
  std::vector<std::vector<int>> outers, cavities;
  for (const auto& piece : pieces_of(body))
    (volume_of(body, piece) > 0 ? outers : cavities).push_back(piece);
  std::vector<std::vector<int>> all = outers;
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
    for (const int f : piece) body.for_each_edge(f, [&](int e) { around.grow(body.at(e)); });
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
  std::map<Side, PlaneId> turned;
  const auto plane = [&](const World& world, Side side) {
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
      const Corners corners(part);
      for (const auto& piece : pieces_of(part)) {
        Shell shell{{}, lump, volume_of(part, piece) < 0};
        for (const int f : piece) {
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

}  // namespace oriel::detail
