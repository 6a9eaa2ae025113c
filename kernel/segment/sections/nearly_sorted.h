#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

namespace oriel::detail {

/// Sorts what mostly stands in order already, or in the opposite one, as what was met facet by
/// facet does: by insertion in linear time, and as ever once that has moved too much. `is_before`
/// must tell any two apart.
template <class T, class Before>
void sort_nearly_sorted(std::span<T> items, Before is_before) {
  constexpr std::size_t kMoves = 4;  // an item: from there on sorting anew costs less
  if (items.size() > 2 && is_before(items.back(), items.front())) std::ranges::reverse(items);
  std::size_t left = kMoves * items.size();
  for (std::size_t i = 1; i < items.size(); ++i) {
    if (!is_before(items[i], items[i - 1])) continue;
    const T item = std::move(items[i]);
    std::size_t place = i;
    for (; place > 0 && is_before(item, items[place - 1]); --place)
      items[place] = std::move(items[place - 1]);
    items[place] = item;
    if (i - place > left) {
      std::ranges::sort(items, is_before);
      return;
    }
    left -= i - place;
  }
}

}  // namespace oriel::detail
