#include "model/description/counting_sort.h"

#include <algorithm>
#include <tuple>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

TEST_SUITE("model") {
  TEST_CASE("buckets hold every item once, by its key and in the order of the items") {
    CHECK(rc::check([] {
      const auto keys = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 7));
      const Buckets buckets = sort_into_buckets(keys, 7);
      std::vector<int> all;
      for (std::size_t k = 0; k < 7; ++k) {
        RC_ASSERT(std::ranges::is_sorted(buckets[k]));
        for (const int item : buckets[k]) {
          RC_ASSERT(keys.at(static_cast<std::size_t>(item)) == static_cast<int>(k));
          all.push_back(item);
        }
      }
      std::ranges::sort(all);
      RC_ASSERT(all.size() == keys.size());
      for (std::size_t i = 0; i < all.size(); ++i) RC_ASSERT(all[i] == static_cast<int>(i));
    }));
  }

  TEST_CASE("edges come in the order of their smaller end, larger end and number, each once") {
    CHECK(rc::check([] {
      const auto from = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 5));
      const auto to = *rc::gen::container<std::vector<int>>(from.size(), rc::gen::inRange(0, 5));
      const auto ends_of = [&](int i) {
        return EdgeEnds(from.at(static_cast<std::size_t>(i)), to.at(static_cast<std::size_t>(i)));
      };
      const auto edges = sort_edges(from.size(), 5, ends_of);
      RC_ASSERT(edges.size() == from.size());
      const auto key = [&](int i) { return std::tuple(ends_of(i).low, ends_of(i).high, i); };
      RC_ASSERT(std::ranges::is_sorted(edges, {}, key));
      RC_ASSERT(std::ranges::adjacent_find(edges) == edges.end());
      for (const int i : edges) {
        RC_ASSERT(ends_of(i).low <= ends_of(i).high);
        RC_ASSERT(ends_of(i) ==
                  EdgeEnds(to[static_cast<std::size_t>(i)], from[static_cast<std::size_t>(i)]));
      }
    }));
  }
}

}  // namespace
}  // namespace oriel::detail
