#pragma once

#include "kernel/segment/segment.h"
#include "kernel/segment/tree/cells.h"
#include "kernel/segment/tree/instances.h"

#include <vector>

namespace oriel::detail {

/// A segmentation as it grows, with all that splitting its bodies needs.
struct GrowingTree {
  GrowingTree(const Solid& solid, const SegmentOptions& how);
  GrowingTree(const GrowingTree&) = delete;
  GrowingTree& operator=(const GrowingTree&) = delete;

  NodeId add_node();
  [[nodiscard]] CsgNode& node(NodeId id) { return out.nodes[id.index()]; }
  [[nodiscard]] FeatureId next_feature() const {
    return FeatureId{static_cast<int>(out.features.size())};
  }
  /// Puts bodies under a node: a single one takes the node itself, several become its `rest`.
  void hang(std::vector<Boundary> bodies, NodeId id);
  /// Adds a part that was taken off `from`: its node, its feature, which is measured, and its body,
  /// which waits.
  WaitingBody& add_part(const WaitingBody& from, Boundary body, int sign, Feature feature);

  const SegmentOptions& options;
  Segmentation out;
  World world;
  CellWriter cells;
  Instances instances;
  PlaneSide ground = -1;
  std::vector<WaitingBody> waiting;  ///< the last is split next
};

}  // namespace oriel::detail
