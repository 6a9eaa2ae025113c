#include "interpret/compile/components.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cstddef>

namespace oriel::rules {

namespace {

constexpr int kUnseen = -1;

class Tarjan {
 public:
  Tarjan(int nodes, const std::vector<std::pair<int, int>>& edges)
      : targets_(oriel::at(nodes)), order_(oriel::at(nodes), kUnseen), low_(oriel::at(nodes), 0) {
    for (const auto& [from, to] : edges) targets_[oriel::at(from)].push_back(to);
    result_.of_node.assign(oriel::at(nodes), kUnseen);
  }

  Components run() {
    for (int node = 0; node < static_cast<int>(order_.size()); ++node)
      if (order_[oriel::at(node)] == kUnseen) visit(node);
    return result_;
  }

 private:
  struct OpenNode {
    int node = 0;
    std::size_t next = 0;
  };

  void enter(int node) {
    order_[oriel::at(node)] = low_[oriel::at(node)] = seen_++;
    stack_.push_back(node);
    open_.push_back({node, 0});
  }

  void visit(int root) {
    enter(root);
    while (!open_.empty()) {
      OpenNode& at = open_.back();
      if (at.next == targets_[oriel::at(at.node)].size()) {
        leave();
        continue;
      }
      const int target = targets_[oriel::at(at.node)][at.next++];
      if (order_[oriel::at(target)] == kUnseen)
        enter(target);
      else if (result_.of_node[oriel::at(target)] == kUnseen)
        low_[oriel::at(at.node)] = std::min(low_[oriel::at(at.node)], order_[oriel::at(target)]);
    }
  }

  void leave() {
    const int node = open_.back().node;
    open_.pop_back();
    if (!open_.empty()) {
      int& low = low_[oriel::at(open_.back().node)];
      low = std::min(low, low_[oriel::at(node)]);
    }
    if (low_[oriel::at(node)] != order_[oriel::at(node)]) return;
    int member = kUnseen;
    while (member != node) {
      member = stack_.back();
      stack_.pop_back();
      result_.of_node[oriel::at(member)] = result_.count;
    }
    ++result_.count;
  }

  std::vector<std::vector<int>> targets_;
  std::vector<int> order_;
  std::vector<int> low_;
  std::vector<int> stack_;
  std::vector<OpenNode> open_;
  int seen_ = 0;
  Components result_;
};

}  // namespace

Components find_components(int nodes, const std::vector<std::pair<int, int>>& edges) {
  return Tarjan(nodes, edges).run();
}

}  // namespace oriel::rules
