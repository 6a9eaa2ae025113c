#include "kernel/model/feature_graph.h"

#include <algorithm>

namespace oriel {

void FeatureGraph::set(const std::string& name, std::vector<Pair> pairs) {
  std::erase_if(pairs, [](const Pair& p) { return p.first == p.second; });
  if (!std::ranges::is_sorted(pairs)) std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  relations_[name] = std::move(pairs);
}

std::span<const FeatureGraph::Pair> FeatureGraph::pairs(std::string_view name) const {
  const auto found = relations_.find(name);
  if (found == relations_.end()) return {};
  return found->second;
}

std::span<const FeatureGraph::Pair> FeatureGraph::of(std::string_view name, FeatureId self) const {
  const auto range = std::ranges::equal_range(pairs(name), self, {}, &Pair::first);
  return {range.begin(), range.end()};
}

}  // namespace oriel
