#pragma once

#include "kernel/base/assert.h"
#include "kernel/base/ids.h"
#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/boundary/scratch.h"
#include "kernel/segment/planes/planes.h"
#include "kernel/segment/planes/points.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// What all bodies of one segmentation share.
struct World {
  /// For the bodies of one solid. The work is counted from 0 up to its budget.
  explicit World(const Solid& solid, Work work_of_all = {})
      : work(work_of_all), planes(solid.planes), points(solid, planes, work) {}

  Work work;
  PlaneTable planes;
  PointTable points;
  Scratch scratch = {};
};

/// A mark on a facet that follows it through cuts and merges: here lies the largest cap of a
/// feature.
struct CapMark {
  FeatureId feature;
  Vec3 point;  ///< inside the cap
};

/// The closed boundary of a body as half-edges with facets of several loops: one outer loop
/// (counter-clockwise seen from outside) and its holes. Vertices are points of the World without
/// any link back, so sheets may touch in a point or along a line without being joined. Facets are
/// maximal but for seams: edges between coplanar facets that a cut is about to use or to heal.
///
/// Half-edges (EdgeId), loops and facets keep their ids; removed ones are marked dead.
class Boundary {
 public:
  struct alignas(16) HalfEdgeRecord {  // 32 bytes: found by a shift
    PointId origin = {};
    EdgeId next = {};  ///< invalid: dead
    EdgeId prev = {};
    EdgeId twin = {};
    LoopId loop = {};
    BodyFacetId facet = {};               ///< that of its loop
    mutable signed char bend = kUnknown;  ///< remembered by is_reflex
  };
  static constexpr signed char kUnknown = -1;
  /// Facets of the solid that a facet is made of, sorted.
  using Sources = boost::container::small_vector<FacetId, 2>;
  struct LoopRecord {
    EdgeId first = {};
    BodyFacetId facet = {};  ///< invalid: dead
    double area = 0;         ///< signed about the facet's normal
    bool is_hole = false;    ///< else an outer loop, be it a sliver
  };
  struct FacetRecord {
    PlaneSide side = -1;  ///< -1: dead
    boost::container::small_vector<LoopId, 2> loops;
    Sources sources;
    std::vector<CapMark> marks;
    int on_side = -1;     ///< where on_side_ counts it
    int outer_loops = 0;  ///< how many of `loops` are no holes
  };

  explicit Boundary(World& world) : world_(&world) {}

  [[nodiscard]] World& world() const { return *world_; }
  /// The same without what is dead. Ids become smaller, none changes its place among the others.
  [[nodiscard]] Boundary without_dead() const;

  // -- Looking.
  [[nodiscard]] int half_edge_count() const { return static_cast<int>(half_edges_.size()); }
  /// How many of them are dead.
  [[nodiscard]] int dead_edge_count() const { return dead_edges_; }
  [[nodiscard]] int facet_count() const { return static_cast<int>(facets_.size()); }
  /// All of them, ascending, dead ones among them.
  [[nodiscard]] auto half_edge_ids() const { return half_edges_.ids(); }
  [[nodiscard]] auto facet_ids() const { return facets_.ids(); }
  [[nodiscard]] const HalfEdgeRecord& edge(EdgeId e) const { return half_edges_[e]; }
  [[nodiscard]] const LoopRecord& loop(LoopId l) const { return loops_[l]; }
  [[nodiscard]] const FacetRecord& facet(BodyFacetId f) const { return facets_[f]; }
  [[nodiscard]] bool is_alive_edge(EdgeId e) const { return edge(e).next.is_valid(); }
  [[nodiscard]] bool is_alive(BodyFacetId f) const { return facet(f).side >= 0; }
  [[nodiscard]] EdgeId next(EdgeId e) const { return edge(e).next; }
  [[nodiscard]] EdgeId prev(EdgeId e) const { return edge(e).prev; }
  [[nodiscard]] EdgeId twin(EdgeId e) const { return edge(e).twin; }
  [[nodiscard]] PointId origin(EdgeId e) const { return edge(e).origin; }
  [[nodiscard]] PointId target(EdgeId e) const { return edge(edge(e).twin).origin; }
  [[nodiscard]] BodyFacetId facet_of(EdgeId e) const { return edge(e).facet; }
  [[nodiscard]] PlaneSide side_of_edge(EdgeId e) const { return facet(facet_of(e)).side; }
  [[nodiscard]] Vec3 at(EdgeId e) const { return world_->points.at(origin(e)); }
  [[nodiscard]] double area(BodyFacetId f) const;
  /// The area of all facets of a side.
  [[nodiscard]] double area_on(PlaneSide side) const;
  /// The same of both sides of a plane, by orientation, and whether there are any facets.
  struct OnPlane {
    std::array<double, 2> areas = {};
    std::array<bool, 2> has_facets = {};
    [[nodiscard]] bool has_area() const { return areas[0] > 0 || areas[1] > 0; }
  };
  [[nodiscard]] OnPlane on_plane(int plane) const;
  /// The sides that have facets, ascending.
  [[nodiscard]] std::vector<PlaneSide> sides() const;
  /// The living facets of a side, ascending.
  [[nodiscard]] std::vector<BodyFacetId> facets_on(PlaneSide side) const;
  [[nodiscard]] std::vector<BodyFacetId> living_facets() const;
  [[nodiscard]] Outline outline(LoopId l) const;
  [[nodiscard]] std::vector<Outline> outlines(BodyFacetId f) const;
  /// A third of the sum of plane offset × facet area.
  [[nodiscard]] double volume() const;
  /// The body bends inward along this edge: more than 180° of material around it.
  [[nodiscard]] bool is_reflex(EdgeId e) const {
    e = std::min(e, twin(e));  // one answer for both half-edges of an edge
    signed char& bend = edge(e).bend;
    if (bend == kUnknown) bend = bends_inward(e) ? 1 : 0;
    return bend != 0;
  }
  /// Calls `visit(half_edge)` for every half-edge of a facet; `visit` must not change the boundary.
  template <class Visit>
  void for_each_edge(BodyFacetId f, Visit visit) const {
    for (const LoopId l : facet(f).loops) {
      const EdgeId first = loop(l).first;
      EdgeId e = first;
      do {
        visit(e);
        e = next(e);
      } while (e != first);
    }
  }

  // -- Making: raw pieces, linked by the caller, then made into loops and facets.
  EdgeId add_edge(PointId origin);
  void link(EdgeId e, EdgeId f) {
    half_edges_[e].next = f;
    half_edges_[f].prev = e;
  }
  void pair(EdgeId e, EdgeId f) {
    ORIEL_ASSERT(e != f);
    half_edges_[e].twin = f;
    half_edges_[f].twin = e;
    half_edges_[e].bend = half_edges_[f].bend = kUnknown;
  }
  /// A facet without loops. `sources`: none that a facet of this boundary holds.
  BodyFacetId add_facet(PlaneSide side, const Sources& sources = {},
                        std::vector<CapMark> marks = {});
  /// The same with the number that number_side() has for the side.
  BodyFacetId add_facet_on(int number, PlaneSide side, const Sources& sources,
                           std::vector<CapMark> marks);
  /// A number for what lies on a side, for as long as the boundary lives.
  int number_side(PlaneSide side);
  /// Room for that many half-edges and facets.
  void reserve(int half_edges, int facets);
  /// Adds half-edges that begin at these points as a loop of facet `f`: each leads to the next, or,
  /// `is_backward`, to the one before. Returns the first half-edge.
  EdgeId add_cycle(std::span<const PointId> origins, BodyFacetId f, bool is_backward = false);
  /// Makes the cycle through `first` a loop of facet `f`.
  LoopId add_loop(EdgeId first, BodyFacetId f);
  void add_mark(BodyFacetId f, const CapMark& mark) { facets_[f].marks.push_back(mark); }
  void add_sources(BodyFacetId f, const Sources& sources);

  /// Puts a new vertex `point` on an edge: e keeps its origin and ends at the point.
  void split_edge(EdgeId e, PointId point);

  // -- Re-shaping facets.
  /// Forgets the loops of a facet and makes new ones of the cycles that its half-edges and `extra`
  /// ones form now. If they have several outer loops the facet falls apart: the first keeps its
  /// number.
  void retrace(BodyFacetId f, std::span<const EdgeId> extra);
  /// Takes the facet `covered`, which faces the cap and lies under it, out of the cap: both vanish
  /// where they lie on each other. To be followed by heal(cap).
  void cover(BodyFacetId cap, BodyFacetId covered);
  /// Makes twins of the edges of a facet that run against each other between the same points, as
  /// where a cap in the open ends at the edge of the facet it covers; what lay beyond them is
  /// paired instead. To be followed by heal(f).
  void zip(BodyFacetId f);
  /// Removes the seams between a facet (a new cap) and its coplanar neighbours, so that facets are
  /// maximal again.
  void heal(BodyFacetId cap);
  /// Takes a hole out of its facet, and its edges out of the body, as a cap there that is healed
  /// does: what lay inside is removed already. `cap_area` is the area of that cap.
  void fill_hole(LoopId hole, double cap_area);
  /// Removes facets with all their half-edges. Twins that stay must be paired anew.
  void remove(std::span<const BodyFacetId> facets);

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  /// What lies on one side of a plane.
  struct OnSide {
    double area = 0;
    boost::container::small_vector<BodyFacetId, 2> facets =
        {};  ///< ascending, with dead ones among them
    int living = 0;
  };
  /// Where a side stands, or would stand, in number_of_side_.
  [[nodiscard]] std::size_t place_of(PlaneSide side) const;
  [[nodiscard]] const OnSide* on_side(PlaneSide side) const;
  [[nodiscard]] OnSide& on_side_of(BodyFacetId f) { return on_side_[index(facets_[f].on_side)]; }
  [[nodiscard]] double perimeter(LoopId l) const;
  LoopId trace(EdgeId first);
  void split_at_corners(BodyFacetId f);
  void kill_edge(EdgeId e) {
    half_edges_[e].next = {};
    ++dead_edges_;
  }
  void attach(LoopId l, BodyFacetId f);
  void join(LoopId l, BodyFacetId f, double area);
  void detach(LoopId l);
  void kill_facet(BodyFacetId f);
  void merge(BodyFacetId target, BodyFacetId f);
  void part(BodyFacetId f);
  void part(BodyFacetId f, std::span<const LoopId> outer, std::span<const LoopId> holes);
  [[nodiscard]] bool bends_inward(EdgeId e) const;
  void distribute_marks(std::span<const BodyFacetId> pieces, std::span<const CapMark> marks);
  [[nodiscard]] std::vector<EdgeId> seams_of(BodyFacetId cap) const;
  void remove_seams(BodyFacetId f, std::span<const EdgeId> seams);

  World* world_;
  IndexedVector<EdgeId, HalfEdgeRecord> half_edges_;
  int dead_edges_ = 0;
  IndexedVector<LoopId, LoopRecord> loops_;
  IndexedVector<BodyFacetId, FacetRecord> facets_;
  std::vector<OnSide> on_side_;                            ///< in no order
  std::vector<std::pair<PlaneSide, int>> number_of_side_;  ///< in on_side_, sorted
};

/// The boundary of one lump of a solid.
Boundary boundary_of(const Solid& solid, int lump, World& world);

/// The loops of a facet without vertices that lie on straight edges, where only two facets meet;
/// the outer loop first. A loop that would keep fewer than three keeps all, and so do its
/// neighbours there: the corners of a closed boundary make a closed solid.
class CornerLoops {
 public:
  explicit CornerLoops(const Boundary& body);
  [[nodiscard]] std::vector<Loop> loops(BodyFacetId facet) const;

 private:
  char& is_corner(EdgeId e) { return is_corner_[e]; }
  bool keep_enough(LoopId loop);

  const Boundary& body_;
  IndexedVector<EdgeId, char> is_corner_;  ///< by half-edge: of its origin
};

/// The side of the ground: the lowest facet that faces down, tilted by no more than `tilt_deg`; -1
/// if there is none.
PlaneSide ground_side(const Solid& solid, const PlaneTable& planes, double tilt_deg);

/// The living edges and facets of a body, close together: for questions that all of them are asked
/// again and again while the body stays as it is. Listed when they are first asked for.
class FlatBody {
 public:
  explicit FlatBody(const Boundary& body) : body_(body) {}

  struct EdgePoints {
    PointId from, to;
  };
  /// A facet and where its plane stands among those of its class.
  struct RankedFacet {
    BodyFacetId number;
    int normal_class;
    int rank;
  };

  [[nodiscard]] const Boundary& body() const { return body_; }
  /// Each edge once, in one of its directions.
  [[nodiscard]] std::span<const EdgePoints> edges();
  [[nodiscard]] std::span<const RankedFacet> facets();

 private:
  const Boundary& body_;
  std::vector<EdgePoints> edges_;
  std::vector<RankedFacet> facets_;
};

}  // namespace oriel::detail
