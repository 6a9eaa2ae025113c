#pragma once

#include <span>
#include <vector>

/// Sorting by small integers in linear time: what the kernel has to group is known by the numbers
/// of its vertices, polygons or facets, so no comparisons are needed.
namespace oriel::detail {

/// Items in buckets: bucket `k` is items[first[k]] … items[first[k + 1] - 1].
struct Buckets {
  std::vector<int> items;
  std::vector<int> first;

  [[nodiscard]] std::span<const int> operator[](std::size_t bucket) const {
    const auto begin = static_cast<std::size_t>(first[bucket]);
    return {items.data() + begin, static_cast<std::size_t>(first[bucket + 1]) - begin};
  }
};

/// Puts item `i` in bucket keys[i] < bucket_count; items of one bucket keep their order.
Buckets sort_into_buckets(std::span<const int> keys, std::size_t bucket_count);

/// A directed edge by its two ends and its place in the list it came from.
struct SortedEdge {
  int low = 0, high = 0, place = 0;

  [[nodiscard]] bool has_ends_of(const SortedEdge& other) const {
    return low == other.low && high == other.high;
  }
};

/// The edges from[i] → to[i] < vertex_count in the order of their smaller end, their larger end,
/// their place: both directions of an edge come together.
std::vector<SortedEdge> sort_edges(std::span<const int> from, std::span<const int> to,
                                   std::size_t vertex_count);

}  // namespace oriel::detail
