#include "kernel/segment/cuts/carve.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/segment/boundary/parting.h"
#include "kernel/segment/planes/points.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

namespace oriel::detail {

namespace {

/// A half-edge for each of some half-edges.
using EdgeMap = std::vector<std::pair<EdgeId, EdgeId>>;

/// A point inside a cap, on its plane; nothing if it has no area.
std::optional<Vec3> point_inside(std::span<const Outline> cap, PlaneSide side,
                                 const PlaneTable& planes) {
  const Vec3 normal = planes.normal(side);
  const auto inside = interior_point(cap, normal);
  if (!inside) return std::nullopt;
  // The first vertex of the outline may be rounded and lie beside its plane.
  const double off = dot(normal, *inside) - planes.offset_m(side);
  return *inside - off * normal;
}

/// The rim of a cap is all of a hole of a facet of the cap's side, so the cap is what fills it.
bool is_hole_of_facet(const Boundary& body, std::span<const CutCap> caps) {
  ORIEL_ASSERT(!caps.empty() && !caps.front().loops.empty());
  const CutCap& cap = caps.front();
  if (caps.size() > 1 || cap.loops.size() > 1 || cap.is_taken || !cap.covered.empty()) return false;
  const auto& edges = cap.loops[0].edges;
  if (std::ranges::any_of(edges, [](const CapEdge& edge) { return !edge.rim.is_valid(); }))
    return false;
  EdgeId before = body.twin(edges.back().rim);
  if (body.side_of_edge(before) != cap.side || !body.loop(body.edge(before).loop).is_hole)
    return false;
  for (const CapEdge& edge : edges) {
    const EdgeId beyond = body.twin(edge.rim);
    if (body.next(beyond) != before) return false;
    before = beyond;
  }
  return true;
}

/// The outline of a cap loop as the rest has it.
void trace_shape(const CapLoop& loop, const PointTable& points, Outline& shape) {
  shape.clear();
  for (const CapEdge& edge : loop.edges) shape.push_back(points.at(edge.from));
}

/// Fills the hole around which a cap's rim ran; what lay inside is removed already. `shape` is the
/// cap's outline, `beyond` one of the hole's half-edges. Returns the point inside the cap at which
/// the mark was left.
Vec3 fill_ring(Boundary& body, const CutCap& cap, const Outline& shape, EdgeId beyond,
               FeatureId mark) {
  const PlaneTable& planes = body.world().planes;
  const auto inside = point_inside({&shape, 1}, cap.side, planes);
  if (inside) body.add_mark(body.facet_of(beyond), {mark, *inside});
  body.fill_hole(body.edge(beyond).loop, signed_area(shape, planes.normal(cap.side)));
  return inside.value_or(Vec3{});
}

class Remover {
 public:
  Remover(Boundary& body, std::span<const CutCap> caps, bool is_hole)
      : body_(body), caps_(caps), is_hole_(is_hole), copier_(body, is_hole) {
    for (const CutCap& cap : caps)
      for (const CapLoop& loop : cap.loops) rim_size_ += loop.edges.size();
    twin_of_rim_.reserve(rim_size_);
    for (const CutCap& cap : caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges)
          if (edge.rim.is_valid()) twin_of_rim_.emplace_back(edge.rim, body.twin(edge.rim));
    std::ranges::sort(twin_of_rim_);
    StampMap<EdgeId, EdgeId>& twins = body.world().scratch.twin_of_rim;
    twins.start(body.half_edge_count());
    for (const auto& [rim, twin] : twin_of_rim_) twins.set(rim, twin);
    is_ring_ = is_hole_of_facet(body, caps);
  }

  /// Finds the facets inside the rims. False if the rims do not part them from the others.
  bool find_lump() {
    StampSet<BodyFacetId>& seen = body_.world().scratch.facets_of_lump;
    seen.start(body_.facet_count());
    const auto push = [&](BodyFacetId f) {
      if (seen.insert(f)) facets_.push_back(f);
    };
    for (const auto& [rim, twin] : twin_of_rim_) push(body_.facet_of(rim));
    bool is_parted = true;
    for (std::size_t i = 0; is_parted && i < facets_.size(); ++i)
      body_.for_each_edge(facets_[i], [&](EdgeId e) {
        if (is_rim(e)) return;
        is_parted &= !is_rim(body_.twin(e));
        push(body_.facet_of(body_.twin(e)));
      });
    std::ranges::sort(facets_);
    return is_parted;
  }

  /// The lump with its caps; the body stays as it is.
  const Boundary& make_lump() {
    copier_.add(facets_);
    close_lump();
    return copier_.boundary();
  }
  /// After make_lump().
  Carved take_off_body(FeatureId mark, std::vector<PointId> touched) {
    touched.reserve(touched.size() + at(copier_.boundary().half_edge_count()) + rim_size_);
    for (const BodyFacetId f : facets_)
      body_.for_each_edge(f, [&](EdgeId e) { touched.push_back(body_.origin(e)); });
    for (const CutCap& cap : caps_)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges) touched.push_back(edge.from);
    body_.remove(facets_);
    if (is_ring_) {
      Outline shape;
      trace_shape(caps_[0].loops[0], body_.world().points, shape);
      cap_point_ = fill_ring(body_, caps_[0], shape, twin_of_rim_[0].second, mark);
    } else {
      close_rest(mark);
    }
    return {std::move(copier_.boundary()), cap_point_, std::move(touched), has_rim_left_};
  }

 private:
  [[nodiscard]] bool is_rim(EdgeId e) const { return twin_of(e).is_valid(); }
  /// The twin that a half-edge of the rim had before the cut; invalid: it is none.
  [[nodiscard]] EdgeId twin_of(EdgeId rim) const {
    return body_.world().scratch.twin_of_rim.find(rim);
  }

  /// A free edge that waits for its other side.
  struct FreeEdge {
    PointId from, to;
    EdgeId edge;
  };

  /// Half-edges of a cap, linked loop by loop into a facet. Free edges wait in `free` for their
  /// other side; those of the rim are added to `of_rim`.
  static BodyFacetId add_cap(Boundary& boundary, const CutCap& cap, PlaneSide side,
                             bool is_backward, std::vector<FreeEdge>& free, EdgeMap& of_rim) {
    const BodyFacetId f = boundary.add_facet(side);
    for (const CapLoop& loop : cap.loops) {
      EdgeId first, last;
      for (const CapEdge& edge : loop.edges) {
        const PointId from = is_backward ? edge.to : edge.from,
                      to = is_backward ? edge.from : edge.to;
        const EdgeId e = boundary.add_edge(from);
        if (!first.is_valid())
          first = e;
        else
          is_backward ? boundary.link(e, last) : boundary.link(last, e);
        last = e;
        if (edge.rim.is_valid())
          of_rim.emplace_back(edge.rim, e);
        else
          pair_free(boundary, {from, to, e}, free);
      }
      is_backward ? boundary.link(first, last) : boundary.link(last, first);
      boundary.add_loop(is_backward ? last : first, f);
    }
    return f;
  }

  static void pair_free(Boundary& boundary, const FreeEdge& open, std::vector<FreeEdge>& free) {
    const auto other = std::ranges::find_if(
        free, [&](const FreeEdge& o) { return o.from == open.to && o.to == open.from; });
    if (other != free.end())
      boundary.pair(open.edge, other->edge);
    else
      free.push_back(open);
  }

  /// A protrusion's own caps look back at the rest; the air of a hole ends where the rest is
  /// closed.
  void close_lump() {
    Boundary& lump = copier_.boundary();
    std::vector<FreeEdge> free;
    EdgeMap of_rim;
    of_rim.reserve(rim_size_);
    for (const CutCap& cap : caps_) {
      const BodyFacetId f =
          add_cap(lump, cap, is_hole_ ? cap.side : cap.side ^ 1, !is_hole_, free, of_rim);
      for (const BodyFacetId g : cap.covered) {
        for (const CapMark& mark : body_.facet(g).marks) lump.add_mark(f, mark);
        lump.add_sources(f, body_.facet(g).sources);
      }
      if (cap.is_taken) lump.add_sources(f, body_.facet(facet_beyond(cap)).sources);
      cap_facets_.push_back(f);
    }
    for (const auto& [rim, e] : of_rim) lump.pair(e, copier_.copy_of(rim));
    // Caps that lie in one plane side by side are one facet; so are the pieces of a facet on both
    // sides of a cut that has only touched it.
    for (const BodyFacetId f : cap_facets_)
      if (lump.is_alive(f)) lump.heal(f);
  }

  void close_rest(FeatureId mark) {
    std::vector<FreeEdge> free;
    EdgeMap of_rim;
    of_rim.reserve(rim_size_);
    std::vector<BodyFacetId> facets;
    for (const CutCap& cap : caps_)
      facets.push_back(add_cap(body_, cap, cap.side, false, free, of_rim));
    std::ranges::sort(of_rim);
    for (const auto& [rim, e] : of_rim) {
      const EdgeId beyond = twin_of(rim);
      body_.pair(e, find_in(of_rim, beyond).value_or(beyond));
    }
    for (std::size_t i = 0; i < caps_.size(); ++i) {
      for (const BodyFacetId g : caps_[i].covered) body_.cover(facets[i], g);
      if (!caps_[i].covered.empty()) body_.zip(facets[i]);
    }
    leave_mark(facets, mark);
    for (std::size_t i = 0; i < caps_.size(); ++i) {
      BodyFacetId f = facets[i];
      if (caps_[i].is_taken) {
        const BodyFacetId ground = facet_beyond(caps_[i]);
        body_.cover(ground, f);
        f = ground;
      }
      if (body_.is_alive(f)) body_.heal(f);
    }
    has_rim_left_ = caps_.size() > 1 || !free.empty() ||
                    std::ranges::any_of(of_rim, [&](const std::pair<EdgeId, EdgeId>& rim) {
                      return body_.is_alive_edge(rim.second);
                    });
  }

  /// The facet beyond the rim of a cap.
  [[nodiscard]] BodyFacetId facet_beyond(const CutCap& cap) const {
    for (const CapLoop& loop : cap.loops)
      for (const CapEdge& edge : loop.edges)
        if (edge.rim.is_valid()) return body_.facet_of(twin_of(edge.rim));
    ORIEL_ASSERT(false, "each cap has an edge of the rim");
    return {};
  }

  /// On the largest new facet; if all caps are parts of old ones, only its point is told.
  void leave_mark(std::span<const BodyFacetId> facets, FeatureId mark) {
    std::size_t best = 0;
    const auto rank = [&](std::size_t i) {
      return std::pair(!caps_[i].is_taken, body_.area(facets[i]));
    };
    for (std::size_t i = 1; i < facets.size(); ++i)
      if (rank(i) > rank(best)) best = i;
    const BodyFacetId largest = facets[best];
    if (const auto inside = point_inside(body_.outlines(largest), body_.facet(largest).side,
                                         body_.world().planes)) {
      cap_point_ = *inside;
      if (!caps_[best].is_taken) body_.add_mark(largest, {mark, cap_point_});
    }
  }

  Boundary& body_;
  std::span<const CutCap> caps_;
  bool is_hole_;
  FacetCopier copier_;
  std::size_t rim_size_ = 0;
  EdgeMap twin_of_rim_;              ///< as they were before the cut, sorted
  std::vector<BodyFacetId> facets_;  ///< of the lump, ascending
  std::vector<BodyFacetId> cap_facets_;
  Vec3 cap_point_;
  bool has_rim_left_ = false;
  bool is_ring_ = false;
};

/// The area of a cap as the lump has it: of a hole as the rest has it, else the other way round.
double area_on_lump(const CapLoop& loop, const PointTable& points, bool is_hole, Vec3 normal,
                    Outline& room) {
  room.clear();
  for (const CapEdge& edge : loop.edges) room.push_back(points.at(is_hole ? edge.from : edge.to));
  if (!is_hole) std::ranges::reverse(room);
  return signed_area(room, normal);
}

/// signed_area() of a loop of a facet, turned round if it is of air.
double area_of_loop(const Boundary& body, LoopId l, bool is_hole, Vec3 normal) {
  const PointTable& points = body.world().points;
  const EdgeId first = body.loop(l).first;
  const Vec3 start = points.at(is_hole ? body.target(first) : body.origin(first));
  Vec3 sum, from;
  for (EdgeId e = first;;) {
    const EdgeId after = is_hole ? body.prev(e) : body.next(e);
    if (after == first) break;
    // The half-edge before one ends where that one begins.
    const Vec3 to = points.at(is_hole ? body.origin(e) : body.origin(after)) - start;
    if (e != first) sum = sum + cross(from, to);
    from = to;
    e = after;
  }
  return dot(sum, normal) / 2;
}

}  // namespace

Filled fill_pocket(Boundary& body, const CutCap& cap, std::span<const BodyFacetId> facets,
                   bool is_hole, FeatureId mark) {
  ORIEL_ASSERT(cap.loops.size() == 1 && !cap.loops[0].edges.empty() && cap.covered.empty());
  const PlaneTable& planes = body.world().planes;
  const PointTable& points = body.world().points;
  Outline& room = body.world().scratch.outline;
  const int flip = is_hole ? 1 : 0;
  Filled filled;
  // Sums as Boundary makes them of a body that is copied facet by facet.
  filled.surface = -area_on_lump(cap.loops[0], points, true, planes.normal(cap.side), room);
  for (const BodyFacetId f : facets) {
    const PlaneSide side = body.facet(f).side ^ flip;
    double facet_area = 0;
    for (const LoopId l : body.facet(f).loops)
      facet_area += area_of_loop(body, l, is_hole, planes.normal(side));
    filled.volume += planes.offset_m(side) * facet_area;
    filled.surface += facet_area;
  }
  const PlaneSide inward = cap.side ^ flip ^ 1;
  const double cap_area = area_on_lump(cap.loops[0], points, is_hole, planes.normal(inward), room);
  filled.volume = (filled.volume + planes.offset_m(inward) * cap_area) / 3;
  filled.surface += cap_area;
  const EdgeId beyond = body.twin(cap.loops[0].edges[0].rim);
  body.remove(facets);
  trace_shape(cap.loops[0], points, room);
  filled.cap_point = fill_ring(body, cap, room, beyond, mark);
  return filled;
}

std::vector<CutCap> turned_round(const Boundary& body, std::span<const CutCap> caps) {
  std::vector<CutCap> turned(caps.begin(), caps.end());
  for (CutCap& cap : turned) {
    ORIEL_ASSERT(cap.covered.empty() && !cap.is_taken);
    cap.side ^= 1;
    for (CapLoop& loop : cap.loops) {
      std::ranges::reverse(loop.edges);
      for (CapEdge& edge : loop.edges) edge = {body.twin(edge.rim), edge.to, edge.from};
    }
  }
  return turned;
}

std::optional<Carved> take_off(Boundary& body, std::span<const CutCap> caps, bool is_hole,
                               FeatureId mark, std::vector<PointId> touched,
                               const LumpCheck& accepts) {
  Remover remover(body, caps, is_hole);
  if (!remover.find_lump()) return std::nullopt;
  const Boundary& lump = remover.make_lump();
  if (accepts && !accepts(lump)) return std::nullopt;
  return remover.take_off_body(mark, std::move(touched));
}

}  // namespace oriel::detail
