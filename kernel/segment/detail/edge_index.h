#pragma once

#include "kernel/segment/detail/boundary.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// For each split plane of a body the edges that it may cross, so that a section costs what it
/// meets and not what the body has. Within a normal class an edge spans an interval of ranks, so it
/// is entered at a run of planes.
class EdgeIndex {
 public:
  /// `planes`: the planes that will be asked for, ascending.
  EdgeIndex(const Boundary& body, const std::vector<int>& planes);

  /// A half-edge of every living edge with ends on both sides of the plane, or on it and beside it;
  /// dead edges and some that were shortened since may be among them. `entry` counts in `planes`.
  [[nodiscard]] std::span<const int> edges_at(std::size_t entry) const { return edges_[entry]; }

  /// Takes in the half-edges that were made since the last time.
  void update();

 private:
  struct Class {
    int number;
    std::vector<int> ranks;            ///< of its planes, ascending
    std::vector<std::size_t> entries;  ///< where they stand in `planes`
    /// For each rank the first plane of that rank or more; empty if the class has many more planes
    /// than are asked for.
    std::vector<int> first;
    [[nodiscard]] std::size_t first_from(int rank) const;
  };
  const Boundary& body_;
  std::vector<Class> classes_;
  std::vector<std::vector<int>> edges_;
  int known_ = 0;  ///< half-edges taken in
};

}  // namespace oriel::detail
