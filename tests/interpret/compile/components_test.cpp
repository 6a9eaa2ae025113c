#include "interpret/compile/components.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

using oriel::rules::Components;
using oriel::rules::find_components;

namespace {

/// True for every pair of nodes with a path from the first to the second.
std::vector<std::vector<bool>> reach(int nodes, const std::vector<std::pair<int, int>>& edges) {
  const auto count = static_cast<std::size_t>(nodes);
  std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count, false));
  for (std::size_t i = 0; i < count; ++i) reaches[i][i] = true;
  for (const auto& [from, to] : edges)
    reaches[static_cast<std::size_t>(from)][static_cast<std::size_t>(to)] = true;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j)
        if (reaches[i][k] && reaches[k][j]) reaches[i][j] = true;
  return reaches;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("components are what reaches each other and edges lead to lower numbers") {
    rc::check("against reachability", [] {
      const int nodes = *rc::gen::inRange(1, 12);
      std::vector<std::pair<int, int>> edges;
      const int count = *rc::gen::inRange(0, 25);
      for (int i = 0; i < count; ++i)
        edges.emplace_back(*rc::gen::inRange(0, nodes), *rc::gen::inRange(0, nodes));
      const Components found = find_components(nodes, edges);
      const auto reaches = reach(nodes, edges);
      for (std::size_t i = 0; i < reaches.size(); ++i)
        for (std::size_t j = 0; j < reaches.size(); ++j) {
          const bool is_together = reaches[i][j] && reaches[j][i];
          RC_ASSERT((found.of_node[i] == found.of_node[j]) == is_together);
          if (reaches[i][j]) RC_ASSERT(found.of_node[i] >= found.of_node[j]);
        }
    });
  }
}
