#include "kernel/segment/instances/models.h"

#include "kernel/base/index.h"

namespace oriel::detail {

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
  copy_subtree(model, *task.copy_of_model, task.node, task.feature, world_, cells_, out_);
  ++out_.stats.instanced;
  return true;
}

}  // namespace oriel::detail
