#pragma once

#include "kernel/base/assert.h"
#include "kernel/segment/boundary/boundary.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// For the split planes of a body, seen from both sides: whether a natural region may be found
/// there. The outline of such a region follows edges of the body, so where the edges that lie in a
/// plane and bound facets of that side form no closed chain there is none, and no section has to be
/// made to know it. Chains may be closed in the ground, where outlines are free, and through necks
/// of facets (SectionOptions::are_necks_free). And the body has
/// facets in the plane that the cut would be compared with: for what chains run around, material or
/// air, on one side or the other.
///
/// Decided by ranks and, what is inside of a chain, by its area, for one class of normals at a
/// time: a look at every edge.
class NaturalChains {
 public:
  /// `planes`: ascending. `free_side`: the ground, -1: none. `are_necks_free`: as of a section.
  NaturalChains(const Boundary& body, std::span<const int> planes, PlaneSide free_side,
                bool are_necks_free);

  /// The body has these edges since. Chains over others have not become more.
  void expect(std::span<const std::pair<PointId, PointId>> new_edges);
  /// Nothing is known any more.
  void forget();
  /// Looks again at the classes in which chains may have become more, as long as there is work
  /// left.
  void refresh();

  /// Slot 2·i is in front of the i-th plane, 2·i + 1 behind it. As of the last refresh(); where
  /// edges have gone since there may be less.
  [[nodiscard]] bool may_be_natural(std::size_t slot) const {
    ORIEL_ASSERT(slot < answers_.size());
    return answers_[slot] != 0;
  }

 private:
  /// A half-edge in a plane, of a facet that is on one side of it there.
  struct ChainStep {
    int slot;
    PointId from, to;
  };
  /// A half-edge in a plane, on both sides of which its facet goes on along the plane's line.
  struct NeckShoulder {
    int entry;       ///< of the plane
    PlaneSide side;  ///< of the facet
    int turn;  ///< the outline leads down there (-1), up (1), or back to where it came from (0)
    PointId from, to;
    friend auto operator<=>(const NeckShoulder&, const NeckShoulder&) = default;
  };
  /// The planes of one class: planes_[first…last).
  struct ChainsOfClass {
    int number;
    std::size_t first, last;
    bool is_known = false;
  };

  /// A living edge, as far as all classes ask of it: its half-edge and the twin of that, where they
  /// begin, and the planes of their facets.
  struct LivingEdge {
    EdgeId half, twin;
    PointId from, to;
    int plane, twin_plane;
  };

  void find_living_edges();
  void forget_grown();
  void look(const ChainsOfClass& c);
  void sort_steps(const ChainsOfClass& c);
  void find_necks();
  void free_necks(int entry);
  /// `entry`: of the plane that the half-edge `e` lies in.
  void add_step(int entry, PointRanks ranks, EdgeId e, PointId from, PointId to);
  [[nodiscard]] std::pair<int, int> ranks_around(PointRanks ranks, EdgeId e, int rank) const;
  [[nodiscard]] bool hangs_below(EdgeId e, PointId from, PointId to, bool is_up) const;
  bool has_chain(std::span<ChainStep> steps, std::size_t slot);
  [[nodiscard]] bool may_bound(std::span<const ChainStep> steps, std::size_t slot);
  [[nodiscard]] bool is_free(PointId point) const {
    return (free_side_ >= 0 && free_ranks_[point] == free_rank_) ||
           (has_necks_here_ && world_.scratch.neck_points.contains(point));
  }

  const Boundary& body_;
  World& world_;
  std::span<const int> planes_;
  PlaneSide free_side_;
  bool are_necks_free_;
  std::vector<ChainsOfClass> classes_;
  std::vector<char> answers_;   ///< by slot
  std::vector<PointId> grown_;  ///< where the body may have grown since the last look

  std::vector<int> entries_;  ///< by plane of the world, where it is in planes_; -1: nowhere

  // Of the look at hand: of the ground, and of the class.
  PointRanks free_ranks_;
  int free_rank_ = 0;
  Vec3 normal_;
  std::vector<LivingEdge> edges_;  ///< the living ones
  std::vector<ChainStep> steps_, sorted_;
  std::vector<NeckShoulder> shoulders_;
  std::vector<std::pair<int, PointId>> necks_;  ///< corners at necks, by entry
  bool has_necks_here_ = false;                 ///< in the plane at hand
  std::vector<int> ends_;
};

}  // namespace oriel::detail
