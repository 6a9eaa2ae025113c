#pragma once

#include "kernel/segment/tree/cells.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oriel::detail {

/// A body that waits to be split, and where it belongs.
struct WaitingBody {
  Boundary body;
  NodeId node;
  FeatureId feature;            ///< the body is in it; invalid: the solid itself
  int sign = 1;                 ///< -1 for air
  std::vector<int> own_planes;  ///< no split planes of this body
  bool has_one_shell = false;   ///< for certain, so it has no cavities
  int model = -1;               ///< others wait for what becomes of it, or it waits itself
  std::optional<Congruence> copy_of_model = std::nullopt;
  std::optional<PocketLeaf> leaf = std::nullopt;  ///< what the body is, which is not made then
};

/// Gives pockets that are congruent to another one a copy of what becomes of that one, their model.
/// Bodies are split from the last that waits to the first, each with all it brings before the next.
class Instances {
 public:
  Instances(World& world, CellWriter& cells, Segmentation& out)
      : world_(world), cells_(cells), out_(out) {}

  /// Of the parts of one node, those that wait from `first` on, the i-th waits for the one that
  /// `models` has for it, as its copy_of_model says; those that are their own model wait for none.
  void let_wait(std::vector<WaitingBody>& waiting, std::size_t first,
                const std::vector<std::size_t>& models);

  /// Splitting `body` begins, and so many wait below it: if it is a model, its subtree begins here.
  void open(const WaitingBody& body, std::size_t waiting);
  /// So many wait now: models whose parts are all split have their whole subtree.
  void close(std::size_t waiting);
  /// Gives a body that waits for a model its copy. False if it waits for none.
  bool copy(const WaitingBody& body);

 private:
  /// The part of a segmentation that one body has become.
  struct Subtree {
    NodeId node;        ///< its root
    FeatureId feature;  ///< the body is in it
    /// What was added below the root: from, up to.
    int first_node = 0, last_node = 0;
    int first_feature = 0, last_feature = 0;
    CellId first_cell, last_cell;
  };
  struct PocketModel {
    Subtree subtree;
    std::size_t waiting = 0;  ///< bodies below it
  };
  class SubtreeCopier;

  World& world_;
  CellWriter& cells_;
  Segmentation& out_;
  std::vector<PocketModel> models_;
  std::vector<int> open_;  ///< those that are being split, the innermost last
};

}  // namespace oriel::detail
