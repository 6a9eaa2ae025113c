#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace oriel::detail {

/// A number for each of some numbers, sorted.
using NumberMap = std::vector<std::pair<int, int>>;

/// The number that `i` is mapped to; nothing if there is none.
inline std::optional<int> find_in(const NumberMap& map, int i) {
  const auto found = std::ranges::lower_bound(map, i, {}, &std::pair<int, int>::first);
  if (found == map.end() || found->first != i) return std::nullopt;
  return found->second;
}

}  // namespace oriel::detail
