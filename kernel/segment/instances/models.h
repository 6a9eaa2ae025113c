#pragma once

#include "kernel/segment/boundary/leaf.h"
#include "kernel/segment/instances/instance.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// A body that waits to be segmented, and where it belongs.
struct Task {
  Boundary body;
  NodeId node;
  FeatureId feature;            ///< the body is in it; invalid: the solid itself
  int sign = 1;                 ///< -1 for air
  std::vector<int> own_planes;  ///< no split planes of this body
  bool has_one_shell = false;   ///< for certain, so it has no cavities
  int model = -1;               ///< others wait for what becomes of it, or it waits itself
  std::optional<Congruence> copy_of_model = std::nullopt;
  std::optional<Leaf> leaf = std::nullopt;  ///< what the body is, which is not made then
};

/// Which bodies others are congruent to, so that those get copies of what becomes of them. Tasks
/// are done from the last to the first, with all they bring before the next.
class Models {
 public:
  Models(World& world, CellWriter& cells, Segmentation& out)
      : world_(world), cells_(cells), out_(out) {}

  /// Of the parts of one node, the tasks from `first`, the i-th waits for the one that `models` has
  /// for it, as its copy_of_model says; those that are their own model wait for none.
  void let_wait(std::vector<Task>& tasks, std::size_t first,
                const std::vector<std::size_t>& models);

  /// Tells that `task` is begun and that so many wait below it: if it is a model, its subtree
  /// begins here.
  void open(const Task& task, std::size_t waiting);
  /// Tells that so many tasks wait: models whose own tasks are all done have their whole subtree.
  void close(std::size_t waiting);
  /// Gives a task that waits for a model its copy. False if it waits for none.
  bool copy(const Task& task);

 private:
  struct Model {
    Subtree subtree;
    std::size_t waiting = 0;  ///< tasks below it
  };
  int number_of(Task& model);

  World& world_;
  CellWriter& cells_;
  Segmentation& out_;
  std::vector<Model> models_;
  std::vector<int> open_;  ///< those that are being split, the innermost last
};

}  // namespace oriel::detail
