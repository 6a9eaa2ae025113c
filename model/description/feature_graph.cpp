#include "model/description/feature_graph.h"

#include <algorithm>
#include <stdexcept>

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
  FeatureLinks links;
  if (!pairs.empty()) links.list_of.assign(pairs.back().first.index() + 1, -1);
  links.others.reserve(pairs.size());
  for (const auto& [self, other] : pairs) {
    if (!self.is_valid() || !other.is_valid())
      throw std::invalid_argument("the relation " + name + " leads to no feature");
    int& list = links.list_of[self.index()];
    if (list < 0) {
      list = static_cast<int>(links.lists());
      links.starts.push_back(links.starts.back());
    }
    ++links.starts.back();
    links.others.push_back(other.value);
  }
  const auto classes = classes_of(links);
  relations_[name] = classes ? links_of_classes(*classes) : std::move(links);
}

void FeatureGraph::set_classes(const std::string& name, std::span<const int> class_of_row) {
  relations_[name] = links_of_classes(class_of_row);
}

const FeatureLinks& FeatureGraph::links(std::string_view name) const {
  static const FeatureLinks none;
  const auto found = relations_.find(name);
  return found == relations_.end() ? none : found->second;
}

std::vector<FeatureId> FeatureGraph::others(std::string_view name, FeatureId self) const {
  std::vector<FeatureId> others;
  const FeatureLinks& links = this->links(name);
  if (self.index() >= links.list_of.size() || links.list_of[self.index()] < 0) return others;
  for (const int other : links.list(static_cast<std::size_t>(links.list_of[self.index()])))
    if (other != self.value) others.push_back(FeatureId{other});
  return others;
}

std::vector<FeatureGraph::Pair> FeatureGraph::pairs(std::string_view name) const {
  std::vector<Pair> pairs;
  const auto rows = static_cast<int>(links(name).list_of.size());
  for (int row = 0; row < rows; ++row)
    for (const FeatureId other : others(name, FeatureId{row}))
      pairs.emplace_back(FeatureId{row}, other);
  return pairs;
}

std::vector<std::string> FeatureGraph::names() const {
  std::vector<std::string> names;
  for (const auto& [name, links] : relations_) names.push_back(name);
  return names;
}

}  // namespace oriel
