#include "model/description/counting_sort.h"

#include "kernel/base/index.h"

#include <algorithm>

namespace oriel {

void count_to_first(Numbers& count) {
  int sum = 0;
  for (int& c : count) {
    const int here = c;
    c = sum;
    sum += here;
  }
}

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

}  // namespace oriel
