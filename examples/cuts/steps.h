#pragma once

#include "model/segmentation.h"

#include <vector>

namespace oriel::cuts {

/// A node of the tree to be shown, and where its body comes from.
struct Step {
  NodeId node;
  /// The step whose cut left or made this body; -1: the whole building.
  int from = -1;
  /// It is a part of that cut, not its rest.
  bool is_part = false;
  /// It is a part, or the rest of one: no longer what the whole building leaves.
  bool is_in_part = false;
};

/// The inner nodes in the order in which a reader wants them: the rest first, down to its leaf
/// (which is a step, too), then the parts that were cut again. Of parts of one node only the first.
std::vector<Step> steps_of(const Segmentation& segmentation);

/// A cell of the body at a node. The signs of the pieces around a point add up to 1 inside the body
/// and to 0 outside.
struct Piece {
  CellId cell;
  int sign = 1;
  /// It belongs to what the node's own cut takes off.
  bool is_part = false;
};
std::vector<Piece> pieces_of(const Segmentation& segmentation, NodeId node);

}  // namespace oriel::cuts
