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
/// cells are those of the model, moved. False, and nothing is added, if the model was cut at a
/// plane that is none of its own.
bool copy_subtree(const Subtree& model, const Congruence& how, NodeId node, FeatureId feature,
                  World& world, CellWriter& cells, Segmentation& out);

}  // namespace oriel::detail
