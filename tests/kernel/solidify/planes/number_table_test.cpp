#include "kernel/solidify/planes/number_table.h"

#include <vector>

#include <doctest/doctest.h>

namespace oriel::detail {

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a number is found by its key among others with the same key") {
    // Keys that collide: every second number has that of the one before.
    const auto key_of = [](int n) { return static_cast<std::uint64_t>(n / 2); };
    constexpr int kCount = 100;
    NumberTable table(2 * kCount);
    for (int n = 0; n < kCount; ++n) {
      int& place = table.at(key_of(n), [&](int other) { return other == n; });
      CHECK(place == -1);
      place = n;
    }
    for (int n = 0; n < kCount; ++n)
      CHECK(table.find(key_of(n), [&](int other) { return other == n; }) == n);
    CHECK(table.find(key_of(0), [](int) { return false; }) == -1);
  }

  TEST_CASE("a table may hold as many numbers as it has places") {
    for (const std::size_t places : {0U, 1U, 2U, 7U, 8U, 9U}) {
      NumberTable table(places);
      for (std::size_t n = 0; n < places; ++n)
        table.at(n, [](int) { return false; }) = static_cast<int>(n);
      CHECK(table.find(places, [](int) { return false; }) == -1);
    }
  }

  TEST_CASE("planes of other directions or offsets have other keys") {
    const std::uint64_t key = table_key({1, 0, 0}, 5);
    CHECK(key == table_key({1, 0, 0}, 5));
    CHECK(key != table_key({0, 1, 0}, 5));
    CHECK(key != table_key({1, 0, 0}, 6));
  }
}

}  // namespace oriel::detail
