#include "model/description/feature_links.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace oriel {

namespace {

std::span<const int> others_of(const FeatureLinks& links, int row) {
  const int list = at(row) < links.list_of.size() ? links.list_of[at(row)] : -1;
  return list < 0 ? std::span<const int>() : links.list(at(list));
}

}  // namespace

/// The first of a class names it with its others. That all of a class have as many others, and none
/// but of it, makes them equal.
std::optional<std::vector<int>> classes_of(const FeatureLinks& links) {
  const int last = links.others.empty() ? -1 : *std::ranges::max_element(links.others);
  // Each is an other of its others.
  const bool is_one_sided = static_cast<int>(links.list_of.size()) <= last;
  if (is_one_sided) return std::nullopt;
  const auto rows = static_cast<int>(links.list_of.size());
  std::vector<int> class_of(at(rows), -1);
  std::vector<std::size_t> others_in;  // by class
  for (int row = 0; row < rows; ++row) {
    const auto others = others_of(links, row);
    int& mine = class_of[at(row)];
    if (others.empty() && mine < 0) continue;
    if (mine < 0) {
      if (others.front() < row) return std::nullopt;
      mine = static_cast<int>(others_in.size());
      others_in.push_back(others.size());
      for (const int other : others)
        if (std::exchange(class_of[at(other)], mine) >= 0) return std::nullopt;
    }
    const bool is_whole = others.size() == others_in[at(mine)];
    if (!is_whole || std::ranges::any_of(others, [&](int o) { return class_of[at(o)] != mine; }))
      return std::nullopt;
  }
  return class_of;
}

FeatureLinks links_of_classes(std::span<const int> class_of_row) {
  FeatureLinks links;
  links.are_classes = true;
  links.list_of.assign(class_of_row.begin(), class_of_row.end());
  int last = -1;
  for (int& list : links.list_of) {
    list = std::max(list, -1);
    last = std::max(last, list);
  }
  std::vector<int>& starts = links.starts;
  starts.assign(at(last + 2), 0);
  for (const int list : links.list_of) ++starts[at(list + 1)];
  starts[0] = 0;  // rows of no list
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  links.others.resize(at(starts.back()));
  std::vector<int> next = starts;
  for (std::size_t row = 0; row < links.list_of.size(); ++row) {
    const int list = links.list_of[row];
    if (list >= 0) links.others[at(next[at(list)]++)] = static_cast<int>(row);
  }
  return links;
}

}  // namespace oriel
