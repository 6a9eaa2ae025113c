#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// For the split planes of a body, seen from both sides: whether a natural region may be found
/// there. The outline of such a region follows edges of the body, so where the edges that lie in a
/// plane and bound facets of that side form no closed chain there is none, and no section has to be
/// made to know it. Chains may be closed in the ground, where outlines are free. And the body has
/// facets in the plane that the cut would be compared with: for what chains run around, material or
/// air, on one side or the other.
///
/// Decided by ranks and, what is inside of a chain, by its area, for one class of normals at a
/// time: a look at every edge.
class NaturalChains {
 public:
  /// `planes`: ascending. `free_side`: the ground, -1: none.
  NaturalChains(const Boundary& body, const std::vector<int>& planes, PlaneSide free_side);

  /// The body has these edges since. Chains over others have not become more.
  void expect(const std::vector<std::pair<int, int>>& new_edges);
  /// Nothing is known any more.
  void forget();
  /// Looks again at the classes in which chains may have become more. True if there were any.
  bool refresh();

  /// Slot 2·i is in front of the i-th plane, 2·i + 1 behind it. As of the last refresh(); where
  /// edges have gone since there may be less.
  [[nodiscard]] bool may_be_natural(std::size_t slot) const { return answers_[slot] != 0; }

 private:
  /// A half-edge in a plane, of a facet that is on one side of it there.
  struct ChainStep {
    int slot;
    int from, to;
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
    int from, to;
    int plane, twin_plane;
  };

  void find_living_edges();
  void look(const ChainsOfClass& c);
  void sort_steps(const ChainsOfClass& c);
  /// `entry`: of the plane that the half-edge `e` lies in.
  void add_step(int entry, std::span<const int> ranks, EdgeId e, int from, int to);
  [[nodiscard]] std::pair<int, int> ranks_around(std::span<const int> ranks, EdgeId e,
                                                 int rank) const;
  [[nodiscard]] bool hangs_below(EdgeId e, int from, int to, bool is_up) const;
  bool has_chain(std::span<ChainStep> steps, std::size_t slot);
  [[nodiscard]] bool may_bound(std::span<const ChainStep> steps, std::size_t slot);
  [[nodiscard]] bool is_free(int point) const {
    return free_side_ >= 0 && free_ranks_[static_cast<std::size_t>(point)] == free_rank_;
  }

  const Boundary& body_;
  World& world_;
  const std::vector<int>& planes_;
  PlaneSide free_side_;
  std::vector<ChainsOfClass> classes_;
  std::vector<char> answers_;  ///< by slot

  std::vector<int> entries_;  ///< by plane of the world, where it is in planes_; -1: nowhere

  // Of the look at hand: of the ground, and of the class.
  std::span<const int> free_ranks_;
  int free_rank_ = 0;
  Vec3 normal_;
  std::vector<LivingEdge> edges_;  ///< the living ones
  std::vector<ChainStep> steps_, sorted_;
  std::vector<int> ends_;
};

}  // namespace oriel::detail
