#pragma once

#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/cut_candidates.h"
#include "kernel/segment/sections/section.h"
#include "kernel/segment/tree/cells.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What congruent pockets are: Pockets::kind_of.
using PocketKindId = Id<struct PocketKindTag>;

/// Finds pockets: lumps that leave nothing but a ring in the facet they are in (or on), a window in
/// its wall. Equal windows are the same pocket moved, so of those of one kind one is flooded, and
/// one is made a body; of the others it is known what would become of them.
///
/// A pocket has one region of its section, whose chords are edges, one each, around a hole of one
/// facet; what lies before them are facets without marks, made of different facets of the solid,
/// and those beside the rim have one loop.
class Pockets {
 public:
  /// `ground`: the side of the ground, -1: none.
  Pockets(const Boundary& body, PlaneSide ground) : body_(body), ground_plane_(ground >> 1) {}

  /// Tells that the body has changed in this way and no other: pockets that the changes have no
  /// point of stay known, with their numbers.
  void changed(std::span<const RestChange> changes);

  /// The pocket in front of a region; invalid if the lump there is none. Of one that
  /// `is_alone` it is not asked whether it is of a kind that is known.
  PocketId find(const Section& section, RegionId region, bool is_alone);
  /// What a flood from the region of a pocket finds, which is sound and finite; nothing if only a
  /// flood can tell.
  struct FloodedPocket {
    double volume;
    bool has_bend;
  };
  [[nodiscard]] std::optional<FloodedPocket> flooded(PocketId pocket, const Section& section,
                                                     const Region& region) const;

  [[nodiscard]] std::size_t kind_count() const { return kinds_.size(); }
  /// Pockets of one kind lie in front of one section and are congruent, in all that a segmentation
  /// asks for (find_congruence).
  [[nodiscard]] PocketKindId kind_of(PocketId pocket) const { return pockets_[pocket].kind; }
  /// As a body of its own it has no reflex edge for certain, and more than two facets meet in all
  /// its vertices: leaf_of() tells what it becomes.
  [[nodiscard]] bool is_leaf(PocketKindId kind) const { return kinds_[kind].is_leaf; }

  /// What a pocket that is_leaf() becomes, but for its volume; `facets` are its facets_of(). Needs
  /// the body as it was.
  [[nodiscard]] PocketLeaf leaf_of(PocketId pocket, std::span<const BodyFacetId> facets,
                                   bool is_hole) const;
  /// Its vertices, sorted; needs the body as it was.
  [[nodiscard]] std::vector<PointId> points_of(PocketId pocket) const;
  /// The cap that closes the rest, as imprint() makes it; needs the body as it was.
  [[nodiscard]] CutCap cap_of(PocketId pocket) const;
  /// Its facets, ascending.
  [[nodiscard]] std::vector<BodyFacetId> facets_of(PocketId pocket) const;
  /// How one pocket is another one of its kind, moved; needs both as they were in the body.
  [[nodiscard]] Congruence congruence(PocketId model, PocketId other) const;

 private:
  struct Pocket {
    PocketKindId kind = {};                  ///< invalid: it has gone
    int first_edge = 0, first_rim = 0;       ///< in edges_, rims_
    std::array<std::int64_t, 3> shift = {};  ///< from the first of its kind, in grid units
  };
  /// A vertex, as a half-edge that begins there.
  struct PocketCorner {
    int edge;
    bool is_on_rim;
    int facets = 0;  ///< of the pocket, that meet there
  };
  /// What pockets of one kind have in common, and the first of them. Half-edges of their facets are
  /// listed facet by facet, in the order in which these are met.
  struct PocketKind {
    PlaneSide cap = -1;  ///< -1: the first has gone, and with it the kind
    int direction = 0;
    bool is_convex = false, is_leaf = false;
    /// Its lump has a bend, and has to be flooded.
    bool has_bend = false, is_unclear = false;
    PocketId first = {};       ///< the first pocket
    Vec3 corner;               ///< the lowest of the box of its rim
    std::vector<int> sizes;    ///< of the facets, in half-edges
    std::vector<int> loops;    ///< the same of their loops
    std::vector<int> entries;  ///< of each facet but the first: the half-edge over which it is met
    std::vector<int> twins;    ///< by half-edge; -1: of the rim
    std::vector<PocketCorner> corners;  ///< one for each vertex
    int rim = 0;                        ///< how many
  };
  /// The vertices, planes and sources of a pocket in the order in which maps from it list them.
  struct PocketOrder {
    PocketId pocket = {};
    std::vector<std::pair<PointId, int>> points;  ///< with a half-edge that begins there
    std::vector<std::pair<int, int>> planes;      ///< with a half-edge of a facet; -1: the cap's
    std::vector<std::tuple<FacetId, int, int>>
        sources;  ///< with a half-edge of their facet, and their place
  };

  [[nodiscard]] PocketId find_known(const Section& section, const Region& region) const;
  bool trace_rim(const Section& section, const Region& region);
  [[nodiscard]] bool is_rim(EdgeId e) const { return body_.world().scratch.rim_edges.contains(e); }
  [[nodiscard]] bool is_like(const PocketKind& kind, Pocket& pocket, const Section& section);
  bool walk_like(const PocketKind& kind, EdgeId start, Vec3 shift);
  bool walk_facet(EdgeId first, std::span<const EdgeId> model, std::span<const int>& loops,
                  Vec3 shift);
  bool walk_loop(EdgeId first, int size);
  [[nodiscard]] std::optional<EdgeId> find_in_facet(BodyFacetId f, Vec3 place) const;
  [[nodiscard]] bool are_corners_like(const PocketKind& kind, Vec3 shift,
                                      const Section& section) const;
  [[nodiscard]] bool are_facets_like(const PocketKind& kind, const Pocket& pocket);
  [[nodiscard]] bool has_own_sources();
  [[nodiscard]] bool is_moved(PlaneSide from, PlaneSide to,
                              const std::array<std::int64_t, 3>& shift) const;
  PocketKindId new_kind(const Section& section, const Region& region);
  bool list_facets(const Section& section, PocketKind& kind);
  bool list_facet(PocketKind& kind, EdgeId first);
  void list_loop(PocketKind& kind, EdgeId first);
  void list_corners(PocketKind& kind);
  void judge(PocketKind& kind, bool is_hole) const;
  [[nodiscard]] bool is_convex_pocket(const PocketKind& kind, std::span<const EdgeId> edges,
                                      bool is_hole) const;
  [[nodiscard]] std::span<const EdgeId> edges_of(const Pocket& pocket) const;
  [[nodiscard]] Vec3 in_metres(const std::array<std::int64_t, 3>& shift) const;
  [[nodiscard]] PocketOrder order_of(PocketId pocket) const;

  const Boundary& body_;
  int ground_plane_;
  IndexedVector<PocketId, Pocket> pockets_;
  IndexedVector<PocketKindId, PocketKind> kinds_;
  std::vector<EdgeId> edges_, rims_;    ///< of the pockets
  StampMap<EdgeId, PocketId> at_edge_;  ///< pockets, by the first crossing of their regions
  mutable PocketOrder order_;           ///< of the model that was asked for last

  // The pocket at hand.
  std::vector<EdgeId> rim_, walk_;
  std::vector<BodyFacetId> facets_;
  BodyFacetId wall_;
  Vec3 corner_;
};

}  // namespace oriel::detail
