#include "kernel/model/feature_links.h"

#include "kernel/model/detail/counting_sort.h"

#include <algorithm>

namespace oriel {

FeatureLinks links_of_classes(std::span<const int> class_of_row) {
  FeatureLinks links;
  links.are_classes = true;
  links.list_of.assign(class_of_row.begin(), class_of_row.end());
  if (class_of_row.empty()) return links;
  // What is of no class comes last, and is cut off.
  const int none = std::max(-1, *std::ranges::max_element(class_of_row)) + 1;
  std::ranges::replace_if(
      links.list_of, [](int c) { return c < 0; }, none);
  const auto lists = static_cast<std::size_t>(none);
  const detail::Buckets buckets = detail::sort_into_buckets(links.list_of, lists + 1);
  std::ranges::replace(links.list_of, none, -1);
  links.starts.assign(buckets.first.begin(), buckets.first.end() - 1);
  links.others.assign(buckets.items.begin(), buckets.items.begin() + links.starts.back());
  return links;
}

}  // namespace oriel
