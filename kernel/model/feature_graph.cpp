#include "kernel/model/feature_graph.h"

#include <algorithm>

namespace oriel {

namespace {

/// Each pair stands behind a smaller one, and none leads to itself: nothing is to be done.
bool is_in_order(const std::vector<FeatureGraph::Pair>& pairs) {
  const FeatureGraph::Pair* last = nullptr;
  for (const FeatureGraph::Pair& pair : pairs) {
    if (pair.first == pair.second || (last != nullptr && !(*last < pair))) return false;
    last = &pair;
  }
  return true;
}

}  // namespace

void FeatureGraph::set(const std::string& name, std::vector<Pair> pairs) {
  if (!is_in_order(pairs)) {
    std::erase_if(pairs, [](const Pair& p) { return p.first == p.second; });
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }
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
