#pragma once

#include <utility>
#include <vector>

namespace oriel::rules {

/// The strongly connected components of a graph. Numbered so that an edge leads to the same or to a
/// lower number.
struct Components {
  int count = 0;
  /// The component of every node.
  std::vector<int> of_node;
};

/// Tarjan 1972, without recursion. Nodes are 0 … nodes - 1, edges lead from first to second.
Components find_components(int nodes, const std::vector<std::pair<int, int>>& edges);

}  // namespace oriel::rules
