#pragma once

#include "model/segmentation.h"

#include <map>
#include <vector>

namespace oriel::detail {

/// Says of which of the leaves around a point it is (see CellComplex): evaluates the tree for the
/// leaves that hold the point.
class Owners {
 public:
  explicit Owners(const Segmentation& segmentation);

  /// The leaf that decides a point held by exactly these cells (ascending); invalid: the point is
  /// outside.
  CellId of(const std::vector<int>& cells);

 private:
  /// What the subtree of a node says of the point.
  struct OwnerVerdict {
    bool is_in_body = false;
    CellId owner;
  };
  struct TreePlace {
    int parent = -1;  ///< position of the node above
    bool is_part_of_difference = false;
  };
  /// The verdicts of the children of a node so far, those of the parts of a difference apart.
  struct Gathered {
    OwnerVerdict rest;
    OwnerVerdict part;
  };
  [[nodiscard]] CellId decide(const std::vector<int>& cells) const;

  /// Nodes by position: the tree in preorder, the rest before the parts.
  std::vector<TreePlace> places_;
  std::vector<int> position_of_cell_;
  std::map<std::vector<int>, CellId> known_;
};

}  // namespace oriel::detail
