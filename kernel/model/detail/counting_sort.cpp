#include "kernel/model/detail/counting_sort.h"

#include <algorithm>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Makes of the number of items in each bucket (one entry more) the place of its first item.
void count_to_first(std::vector<int>& count) {
  int sum = 0;
  for (int& c : count) {
    const int here = c;
    c = sum;
    sum += here;
  }
}

}  // namespace

Buckets sort_into_buckets(std::span<const int> keys, std::size_t bucket_count) {
  Buckets out;
  out.first.assign(bucket_count + 1, 0);
  for (const int key : keys) ++out.first[at(key)];
  count_to_first(out.first);
  out.items.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
    out.items[at(out.first[at(keys[i])]++)] = static_cast<int>(i);
  // Filling moved every first place to the next bucket's: back by one bucket.
  std::shift_right(out.first.begin(), out.first.end(), 1);
  out.first[0] = 0;
  return out;
}

std::vector<SortedEdge> sort_edges(std::span<const int> from, std::span<const int> to,
                                   std::size_t vertex_count) {
  // Stably by the larger end, then stably by the smaller one.
  std::vector<int> of_low(vertex_count + 1, 0), of_high(vertex_count + 1, 0);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto [low, high] = std::minmax(from[i], to[i]);
    ++of_low[at(low)];
    ++of_high[at(high)];
  }
  count_to_first(of_low);
  count_to_first(of_high);
  std::vector<SortedEdge> by_high(from.size()), edges(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto [low, high] = std::minmax(from[i], to[i]);
    by_high[at(of_high[at(high)]++)] = {low, high, static_cast<int>(i)};
  }
  for (const SortedEdge& edge : by_high) edges[at(of_low[at(edge.low)]++)] = edge;
  return edges;
}

}  // namespace oriel::detail
