#pragma once

#include "kernel/base/ids.h"
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
/// Half-edges, loops and facets keep their numbers; removed ones are marked dead.
class Boundary {
 public:
  struct alignas(16) HalfEdgeRecord {  // 32 bytes: found by a shift
    int origin = -1;
    int next = -1;  ///< -1: dead
    int prev = -1;
    int twin = -1;
    int loop = -1;
    int facet = -1;                       ///< that of its loop
    mutable signed char bend = kUnknown;  ///< remembered by is_reflex
  };
  static constexpr signed char kUnknown = -1;
  /// Facets of the solid that a facet is made of, sorted.
  using Sources = boost::container::small_vector<int, 2>;
  struct LoopRecord {
    int first = -1;
    int facet = -1;        ///< -1: dead
    double area = 0;       ///< signed about the facet's normal
    bool is_hole = false;  ///< else an outer loop, be it a sliver
  };
  struct FacetRecord {
    PlaneSide side = -1;  ///< -1: dead
    boost::container::small_vector<int, 2> loops;
    Sources sources;
    std::vector<CapMark> marks;
    int on_side = -1;     ///< where on_side_ counts it
    int outer_loops = 0;  ///< how many of `loops` are no holes
  };

  explicit Boundary(World& world) : world_(&world) {}

  [[nodiscard]] World& world() const { return *world_; }

  // -- Looking.
  [[nodiscard]] int half_edge_count() const { return static_cast<int>(half_edges_.size()); }
  /// How many of them are dead.
  [[nodiscard]] int dead_edge_count() const { return dead_edges_; }
  [[nodiscard]] int facet_count() const { return static_cast<int>(facets_.size()); }
  [[nodiscard]] const HalfEdgeRecord& edge(int e) const { return half_edges_[index(e)]; }
  [[nodiscard]] const LoopRecord& loop(int l) const { return loops_[index(l)]; }
  [[nodiscard]] const FacetRecord& facet(int f) const { return facets_[index(f)]; }
  [[nodiscard]] bool is_alive_edge(int e) const { return edge(e).next >= 0; }
  [[nodiscard]] bool is_alive(int f) const { return facet(f).side >= 0; }
  [[nodiscard]] int next(int e) const { return edge(e).next; }
  [[nodiscard]] int prev(int e) const { return edge(e).prev; }
  [[nodiscard]] int twin(int e) const { return edge(e).twin; }
  [[nodiscard]] int origin(int e) const { return edge(e).origin; }
  [[nodiscard]] int target(int e) const { return edge(edge(e).twin).origin; }
  [[nodiscard]] int facet_of(int e) const { return edge(e).facet; }
  [[nodiscard]] PlaneSide side_of_edge(int e) const { return facet(facet_of(e)).side; }
  [[nodiscard]] Vec3 at(int e) const { return world_->points.at(origin(e)); }
  [[nodiscard]] double area(int f) const;
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
  [[nodiscard]] std::vector<int> facets_on(PlaneSide side) const;
  [[nodiscard]] std::vector<int> living_facets() const;
  [[nodiscard]] Outline outline(int l) const;
  [[nodiscard]] std::vector<Outline> outlines(int f) const;
  /// A third of the sum of plane offset × facet area.
  [[nodiscard]] double volume() const;
  /// The body bends inward along this edge: more than 180° of material around it.
  [[nodiscard]] bool is_reflex(int e) const {
    e = std::min(e, twin(e));  // one answer for both half-edges of an edge
    signed char& bend = edge(e).bend;
    if (bend == kUnknown) bend = bends_inward(e) ? 1 : 0;
    return bend != 0;
  }
  /// Calls `visit(half_edge)` for every half-edge of a facet; `visit` must not change the boundary.
  template <class Visit>
  void for_each_edge(int f, Visit visit) const {
    for (const int l : facet(f).loops) {
      const int first = loop(l).first;
      int e = first;
      do {
        visit(e);
        e = next(e);
      } while (e != first);
    }
  }

  // -- Making: raw pieces, linked by the caller, then made into loops and facets.
  int add_edge(int origin);
  void link(int e, int f) {
    half_edges_[index(e)].next = f;
    half_edges_[index(f)].prev = e;
  }
  void pair(int e, int f) {
    half_edges_[index(e)].twin = f;
    half_edges_[index(f)].twin = e;
    half_edges_[index(e)].bend = half_edges_[index(f)].bend = kUnknown;
  }
  /// A facet without loops. `sources`: none that a facet of this boundary holds.
  int add_facet(PlaneSide side, const Sources& sources = {}, std::vector<CapMark> marks = {});
  /// The same with the number that number_side() has for the side.
  int add_facet_on(int number, PlaneSide side, const Sources& sources, std::vector<CapMark> marks);
  /// A number for what lies on a side, for as long as the boundary lives.
  int number_side(PlaneSide side);
  /// Room for that many half-edges and facets.
  void reserve(int half_edges, int facets);
  /// Adds half-edges that begin at these points as a loop of facet `f`: each leads to the next, or,
  /// `is_backward`, to the one before. Returns the first half-edge.
  int add_cycle(std::span<const int> origins, int f, bool is_backward = false);
  /// Makes the cycle through `first` a loop of facet `f`.
  int add_loop(int first, int f);
  void add_mark(int f, const CapMark& mark) { facets_[index(f)].marks.push_back(mark); }
  void add_sources(int f, const Sources& sources);

  /// Puts a new vertex `point` on an edge: e keeps its origin and ends at the point.
  void split_edge(int e, int point);

  // -- Re-shaping facets.
  /// Forgets the loops of a facet and makes new ones of the cycles that its half-edges and `extra`
  /// ones form now. If they have several outer loops the facet falls apart: the first keeps its
  /// number.
  void retrace(int f, std::span<const int> extra);
  /// Takes the facet `covered`, which faces the cap and lies under it, out of the cap: both vanish
  /// where they lie on each other. To be followed by heal(cap).
  void cover(int cap, int covered);
  /// Makes twins of the edges of a facet that run against each other between the same points, as
  /// where a cap in the open ends at the edge of the facet it covers; what lay beyond them is
  /// paired instead. To be followed by heal(f).
  void zip(int f);
  /// Removes the seams between a facet (a new cap) and its coplanar neighbours, so that facets are
  /// maximal again.
  void heal(int cap);
  /// Takes a hole out of its facet, and its edges out of the body, as a cap there that is healed
  /// does: what lay inside is removed already. `cap_area` is the area of that cap.
  void fill_hole(int hole, double cap_area);
  /// Removes facets with all their half-edges. Twins that stay must be paired anew.
  void remove(const std::vector<int>& facets);

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  /// What lies on one side of a plane.
  struct OnSide {
    double area = 0;
    boost::container::small_vector<int, 2> facets = {};  ///< ascending, with dead ones among them
    int living = 0;
  };
  /// Where a side stands, or would stand, in number_of_side_.
  [[nodiscard]] std::size_t place_of(PlaneSide side) const;
  [[nodiscard]] const OnSide* on_side(PlaneSide side) const;
  [[nodiscard]] OnSide& on_side_of(int f) { return on_side_[index(facets_[index(f)].on_side)]; }
  [[nodiscard]] double perimeter(int l) const;
  int trace(int first);
  void split_at_corners(int f);
  void kill_edge(int e) {
    half_edges_[index(e)].next = -1;
    ++dead_edges_;
  }
  void attach(int l, int f);
  void join(int l, int f, double area);
  void detach(int l);
  void kill_facet(int f);
  void merge(int target, int f);
  void part(int f);
  void part(int f, std::span<const int> outer, std::span<const int> holes);
  [[nodiscard]] bool bends_inward(int e) const;
  void distribute_marks(std::span<const int> pieces, const std::vector<CapMark>& marks);
  [[nodiscard]] std::vector<int> seams_of(int cap) const;
  void remove_seams(int f, const std::vector<int>& seams);

  World* world_;
  std::vector<HalfEdgeRecord> half_edges_;
  int dead_edges_ = 0;
  std::vector<LoopRecord> loops_;
  std::vector<FacetRecord> facets_;
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
  [[nodiscard]] std::vector<Loop> loops(int facet) const;

 private:
  char& is_corner(int e) { return is_corner_[static_cast<std::size_t>(e)]; }
  bool keep_enough(int loop);

  const Boundary& body_;
  std::vector<char> is_corner_;  ///< by half-edge: of its origin
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
    int from, to;  ///< points
  };
  /// A facet and where its plane stands among those of its class.
  struct RankedFacet {
    int number;
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
