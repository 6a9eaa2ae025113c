#include "kernel/segment/instances/models.h"

#include "kernel/base/index.h"
#include "kernel/base/issue.h"

#include <cmath>

namespace oriel::detail {

void Models::find_congruent(std::vector<Task>& tasks, std::size_t first, Side ground) {
  for (std::size_t i = tasks.size(); i-- > first;)
    for (std::size_t j = tasks.size(); --j > i;)
      if (!tasks[j].copy_of_model && become_copy(tasks[i], tasks[j], ground)) break;
}

void Models::let_wait(std::vector<Task>& tasks, std::size_t first,
                      const std::vector<std::size_t>& models) {
  for (std::size_t i = 0; i < models.size(); ++i)
    if (models[i] != i) tasks[first + i].model = number_of(tasks[first + models[i]]);
}

int Models::number_of(Task& model) {
  if (model.model < 0) {
    model.model = static_cast<int>(models_.size());
    models_.emplace_back();
  }
  return model.model;
}

bool Models::become_copy(Task& task, Task& model, Side ground) {
  const Feature &one = out_.features[model.feature.index()],
                &two = out_.features[task.feature.index()];
  constexpr double kSame = 1e-9;  // tolerance of doubles; what is congruent is decided exactly
  if (std::abs(one.volume_m3 - two.volume_m3) > kSame * one.volume_m3) return false;
  auto how = find_congruence(model.body, task.body, ground);
  if (!how) return false;
  // The planes of their cut are no split planes of either.
  for (const int plane : model.own_planes)
    if (find_in(how->planes, plane).value_or(plane) != plane) return false;
  task.model = number_of(model);
  task.copy_of_model = std::move(how);
  return true;
}

void Models::open(const Task& task, std::size_t waiting) {
  if (task.model < 0 || task.copy_of_model) return;
  const int node = static_cast<int>(out_.nodes.size()),
            feature = static_cast<int>(out_.features.size());
  const CellId cell{static_cast<int>(out_.cells.size())};
  models_[at(task.model)] = {{task.node, task.feature, node, node, feature, feature, cell, cell},
                             waiting};
  open_.push_back(task.model);
}

void Models::close(std::size_t waiting) {
  while (!open_.empty()) {
    Model& model = models_[at(open_.back())];
    if (waiting >= model.waiting) return;
    model.subtree.last_node = static_cast<int>(out_.nodes.size());
    model.subtree.last_feature = static_cast<int>(out_.features.size());
    model.subtree.last_cell = CellId{static_cast<int>(out_.cells.size())};
    open_.pop_back();
  }
}

bool Models::copy(const Task& task) {
  if (!task.copy_of_model) return false;
  const Subtree& model = models_[at(task.model)].subtree;
  if (!copy_subtree(model, *task.copy_of_model, task.node, task.feature, world_, cells_, out_)) {
    // No cut has a plane that its body has not, so a pocket's copy is always made.
    if (task.body.half_edge_count() == 0) throw GeometryError("a copy of a pocket has lost planes");
    return false;
  }
  ++out_.stats.instanced;
  return true;
}

}  // namespace oriel::detail
