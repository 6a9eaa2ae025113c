#include "kernel/io/cityjson/families.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace oriel::detail {

std::vector<std::size_t> families_of(const std::vector<Relative>& members) {
  std::vector<std::size_t> root(members.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::unordered_map<std::string_view, std::size_t> number_of;
  for (std::size_t i = 0; i < members.size(); ++i) number_of.try_emplace(members[i].id, i);
  for (std::size_t i = 0; i < members.size(); ++i)
    for (const std::string_view id : members[i].relatives)
      if (const auto found = number_of.find(id); found != number_of.end()) {
        const std::size_t a = root_of(i);
        const std::size_t b = root_of(found->second);
        root[std::max(a, b)] = std::min(a, b);
      }
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = root_of(i);
  return root;
}

}  // namespace oriel::detail
