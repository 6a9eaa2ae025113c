#pragma once

#include "kernel/segment/detail/boundary.h"
#include "kernel/segment/detail/growing_lists.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

/// The edges that sections of a body may cross, so that a section costs what it meets and not what
/// the body has. The split planes of a normal class leave gaps between them, and one before the
/// first and behind the last; an edge is entered in each gap that it runs through, and the section
/// at P ± 0 is that of the gap there.
class EdgeIndex {
 public:
  /// `planes`: those that will be asked for, ascending.
  EdgeIndex(const Boundary& body, const std::vector<int>& planes);

  /// A half-edge of every living edge that runs through the gap in front of a plane (`direction`
  /// +1, as its class has it), or behind it (-1); dead edges and some that were shortened since may
  /// be among them. `entry` counts in `planes`.
  [[nodiscard]] std::span<const int> edges_at(std::size_t entry, int direction) const {
    return edges_[first_gaps_[entry] + (direction > 0 ? 1 : 0)];
  }

  /// Takes in the half-edges that were made since the last time.
  void update();

 private:
  /// A living half-edge that speaks for its edge.
  struct Edge {
    int half, from, to;
  };
  struct Class {
    int number;
    std::vector<int> ranks;  ///< of its planes, ascending
    std::size_t first_gap;   ///< in edges_: the one before the first plane
    /// For each rank how many planes have a lesser one; empty if the class has many more planes
    /// than are asked for.
    std::vector<int> before;
    [[nodiscard]] std::size_t planes_before(int rank) const;
  };
  void make_tables();
  [[nodiscard]] std::vector<Edge> new_edges() const;
  /// A half-edge whose edge is not level, and the gaps that it runs through.
  struct Run {
    int half, first, last;
  };
  [[nodiscard]] std::vector<Run> runs_of(std::span<const Edge> edges) const;

  const Boundary& body_;
  std::vector<Class> classes_;
  std::vector<std::size_t> first_gaps_;  ///< of each plane the gap behind it
  std::size_t gaps_ = 0;
  GrowingLists edges_;  ///< by gap
  int known_ = 0;       ///< half-edges taken in
};

}  // namespace oriel::detail
