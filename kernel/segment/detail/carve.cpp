#include "kernel/segment/detail/carve.h"

#include "kernel/geometry/exact.h"
#include "kernel/model/issue.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Copies facets with their half-edges into a boundary of their own. Turned round, air becomes a
/// body.
class Copier {
 public:
  Copier(const Boundary& from, bool is_turned)
      : from_(from), to_(from.world()), is_turned_(is_turned) {}

  void add(int f) {
    const auto& facet = from_.facet(f);
    const int copy =
        to_.add_facet(is_turned_ ? facet.side ^ 1 : facet.side, facet.sources, facet.marks);
    from_.for_each_edge(f, [&](int e) {
      copy_of_[e] = to_.add_edge(is_turned_ ? from_.target(e) : from_.origin(e));
    });
    from_.for_each_edge(f, [&](int e) {
      if (is_turned_)
        to_.link(copy_of_.at(from_.next(e)), copy_of_.at(e));
      else
        to_.link(copy_of_.at(e), copy_of_.at(from_.next(e)));
    });
    for (const int l : facet.loops) to_.add_loop(copy_of_.at(from_.loop(l).first), copy);
    facets_.push_back(f);
  }

  /// Pairs the copies of edges whose two sides were both copied.
  void pair_twins() {
    for (const auto& [e, copy] : copy_of_)
      if (const auto twin = copy_of_.find(from_.twin(e)); twin != copy_of_.end())
        to_.pair(copy, twin->second);
  }

  [[nodiscard]] int copy_of(int e) const { return copy_of_.at(e); }
  [[nodiscard]] const std::vector<int>& facets() const { return facets_; }
  Boundary& boundary() { return to_; }

 private:
  const Boundary& from_;
  Boundary to_;
  bool is_turned_;
  std::unordered_map<int, int> copy_of_;
  std::vector<int> facets_;
};

class Remover {
 public:
  Remover(Boundary& body, const std::vector<Cap>& caps, bool is_hole)
      : body_(body), caps_(caps), is_hole_(is_hole), copier_(body, is_hole) {
    for (const Cap& cap : caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges)
          if (edge.rim >= 0) twin_of_rim_[edge.rim] = body.twin(edge.rim);
  }

  Carved run(FeatureId mark, std::vector<int> touched) {
    for (const int f : lump_facets()) copier_.add(f);
    copier_.pair_twins();
    close_lump();
    for (const int f : copier_.facets())
      body_.for_each_edge(f, [&](int e) { touched.push_back(body_.origin(e)); });
    for (const Cap& cap : caps_)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges) touched.push_back(edge.from);
    body_.remove(copier_.facets());
    close_rest(mark);
    return {std::move(copier_.boundary()), cap_point_, std::move(touched)};
  }

 private:
  /// The facets inside the rims, ascending.
  std::vector<int> lump_facets() const {
    std::unordered_set<int> is_beyond_rim;
    for (const auto& [rim, twin] : twin_of_rim_)
      if (!twin_of_rim_.contains(twin)) is_beyond_rim.insert(twin);
    std::vector<int> facets;
    std::vector<char> is_seen(at(body_.facet_count()), 0);
    const auto push = [&](int f) {
      if (is_seen[at(f)]) return;
      is_seen[at(f)] = 1;
      facets.push_back(f);
    };
    for (const auto& [rim, twin] : twin_of_rim_) push(body_.facet_of(rim));
    for (std::size_t i = 0; i < facets.size(); ++i)
      body_.for_each_edge(facets[i], [&](int e) {
        if (is_beyond_rim.contains(e))
          throw GeometryError("the rim of a cut does not separate a lump");
        if (!twin_of_rim_.contains(e)) push(body_.facet_of(body_.twin(e)));
      });
    std::ranges::sort(facets);
    return facets;
  }

  /// Half-edges of a cap, linked loop by loop into a facet. Free edges wait in `free` for their
  /// other side.
  int add_cap(Boundary& boundary, const Cap& cap, Side side, bool is_backward,
              std::map<std::pair<int, int>, int>& free, std::unordered_map<int, int>& of_rim) {
    const int f = boundary.add_facet(side);
    for (const CapLoop& loop : cap.loops) {
      std::vector<int> edges;
      for (const CapEdge& edge : loop.edges) {
        const int from = is_backward ? edge.to : edge.from, to = is_backward ? edge.from : edge.to;
        const int e = boundary.add_edge(from);
        edges.push_back(e);
        if (edge.rim >= 0)
          of_rim[edge.rim] = e;
        else if (const auto other = free.find({to, from}); other != free.end())
          boundary.pair(e, other->second);
        else
          free[{from, to}] = e;
      }
      if (is_backward) std::ranges::reverse(edges);
      for (std::size_t i = 0; i < edges.size(); ++i)
        boundary.link(edges[i], edges[(i + 1) % edges.size()]);
      boundary.add_loop(edges[0], f);
    }
    return f;
  }

  /// A protrusion's own caps look back at the rest; the air of a hole ends where the rest is
  /// closed.
  void close_lump() {
    Boundary& lump = copier_.boundary();
    std::map<std::pair<int, int>, int> free;
    std::unordered_map<int, int> of_rim;
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
    std::map<std::pair<int, int>, int> free;
    std::unordered_map<int, int> of_rim;
    std::vector<int> facets;
    for (const Cap& cap : caps_)
      facets.push_back(add_cap(body_, cap, cap.side, false, free, of_rim));
    for (const auto& [rim, e] : of_rim) {
      const int beyond = twin_of_rim_.at(rim);
      const auto also_rim = of_rim.find(beyond);
      body_.pair(e, also_rim == of_rim.end() ? beyond : also_rim->second);
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
        if (edge.rim >= 0) return body_.facet_of(twin_of_rim_.at(edge.rim));
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
  std::unordered_map<int, int> twin_of_rim_;
  std::vector<int> cap_facets_;
  Vec3 cap_point_;
};

/// The living facets in connected pieces, in the order of their first facets.
std::vector<std::vector<int>> pieces_of(const Boundary& body) {
  std::vector<std::vector<int>> pieces;
  std::vector<char> is_seen(at(body.facet_count()), 0);
  for (int start = 0; start < body.facet_count(); ++start) {
    if (!body.is_alive(start) || is_seen[at(start)]) continue;
    std::vector<int> piece{start};
    is_seen[at(start)] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i)
      body.for_each_edge(piece[i], [&](int e) {
        const int g = body.facet_of(body.twin(e));
        if (is_seen[at(g)]) return;
        is_seen[at(g)] = 1;
        piece.push_back(g);
      });
    std::ranges::sort(piece);
    pieces.push_back(std::move(piece));
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
  for (const int f : facets) copier.add(f);
  copier.pair_twins();
  return std::move(copier.boundary());
}

}  // namespace

Carved take_off(Boundary& body, const std::vector<Cap>& caps, bool is_hole, FeatureId mark,
                std::vector<int> touched) {
  return Remover(body, caps, is_hole).run(mark, std::move(touched));
}

bool is_connected(const Boundary& body) { return pieces_of(body).size() == 1; }

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
  const auto pieces = pieces_of(body);
  if (pieces.size() == 1) return cavities;
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
