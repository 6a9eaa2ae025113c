#pragma once

#include "kernel/base/text/numbers.h"

#include <cstddef>
#include <span>

/// Sorting by small integers in linear time: what the kernel has to group is known by the numbers
/// of its vertices, polygons or facets, so no comparisons are needed.
namespace oriel {

/// Items in buckets: bucket `k` is items[first[k]] … items[first[k + 1] - 1].
struct Buckets {
  Numbers items;
  Numbers first;

  [[nodiscard]] std::span<const int> operator[](std::size_t bucket) const {
    const auto begin = static_cast<std::size_t>(first[bucket]);
    return {items.data() + begin, static_cast<std::size_t>(first[bucket + 1]) - begin};
  }
};

/// Puts item `i` in bucket keys[i] < bucket_count; items of one bucket keep their order.
Buckets sort_into_buckets(std::span<const int> keys, std::size_t bucket_count);

/// Makes of the number of items in every bucket the place of its first item.
void count_to_first(Numbers& count);

/// The ends of an undirected edge, the smaller one first.
struct EdgeEnds {
  int low = 0, high = 0;
  EdgeEnds(int from, int to) : low(from < to ? from : to), high(from < to ? to : from) {}
  friend bool operator==(const EdgeEnds&, const EdgeEnds&) = default;
};

/// The edges 0…edge_count-1 in the order of their smaller end, their larger end, their number: both
/// directions of an edge come together. `ends_of(i)` are the ends of edge `i`, vertices <
/// vertex_count.
template <class EndsOf>
Numbers sort_edges(std::size_t edge_count, std::size_t vertex_count, EndsOf ends_of) {
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const int count = static_cast<int>(edge_count);
  Numbers of_low(vertex_count, 0), of_high(vertex_count, 0);
  for (int i = 0; i < count; ++i) {
    const EdgeEnds ends = ends_of(i);
    ++of_low[at(ends.low)];
    ++of_high[at(ends.high)];
  }
  count_to_first(of_low);
  count_to_first(of_high);
  // By the larger end, then stably by the smaller one.
  Numbers by_high(edge_count), sorted(edge_count);
  for (int i = 0; i < count; ++i) by_high[at(of_high[at(ends_of(i).high)]++)] = i;
  for (const int i : by_high) sorted[at(of_low[at(ends_of(i).low)]++)] = i;
  return sorted;
}

}  // namespace oriel
