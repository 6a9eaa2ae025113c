#pragma once

#include "kernel/segment/instances/congruence.h"
#include "kernel/segment/tree/cells.h"

namespace oriel::detail {

/// The part of a segmentation that one body has become.
struct Subtree {
  NodeId node;        ///< its root
  FeatureId feature;  ///< the body is in it
  /// What was added below the root: from, up to.
  int first_node = 0, last_node = 0;
  int first_feature = 0, last_feature = 0;
  CellId first_cell, last_cell;
};

/// Gives the body at `node`, in `feature`, the subtree of a congruent one: nodes, features and
/// cells are those of the model, moved. No cut has a plane that its body has not, so `how` has all
/// planes of the subtree.
void copy_subtree(const Subtree& model, const Congruence& how, NodeId node, FeatureId feature,
                  World& world, CellWriter& cells, Segmentation& out);

}  // namespace oriel::detail
