#include "kernel/segment/sections/even_search.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("a search without branches finds what std::lower_bound finds, in lists of any length") {
    std::vector<std::pair<int, char>> sorted;
    for (int size = 0; size < 40; ++size) {
      for (int value = -2; value < 90; ++value) {
        const auto found =
            std::ranges::lower_bound(sorted, value, {}, &std::pair<int, char>::first);
        CAPTURE(size);
        CAPTURE(value);
        CHECK(detail::first_not_less(std::span<const std::pair<int, char>>(sorted), value,
                                     &std::pair<int, char>::first) ==
              static_cast<std::size_t>(found - sorted.begin()));
      }
      sorted.emplace_back(2 * size + size % 3 / 2, 'a');
    }
  }
}

}  // namespace
}  // namespace oriel
