#include "kernel/segment/detail/growing_lists.h"

#include <algorithm>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("lists that outgrow their room hold what plain lists hold") {
    std::mt19937 random(3);
    for (const int most : {0, 1, 5}) {
      std::vector<int> rooms(20);
      for (int& room : rooms) room = static_cast<int>(random() % static_cast<unsigned>(most + 1));
      detail::GrowingLists lists;
      lists.make(rooms);
      std::vector<std::vector<int>> plain(rooms.size());
      for (int number = 0; number < 1000; ++number) {
        const std::size_t i = random() % plain.size();
        lists.push_back(i, number);
        plain[i].push_back(number);
      }
      for (std::size_t i = 0; i < plain.size(); ++i) CHECK(std::ranges::equal(lists[i], plain[i]));
    }
  }

  TEST_CASE("a number is put into a run of lists at once") {
    detail::GrowingLists lists;
    lists.make(std::vector<int>{2, 0, 1, 0});
    for (int number = 0; number < 7; ++number) lists.push_back(1, 2, number);
    const std::vector<int> all{0, 1, 2, 3, 4, 5, 6};
    CHECK(lists[0].empty());
    CHECK(std::ranges::equal(lists[1], all));
    CHECK(std::ranges::equal(lists[2], all));
    CHECK(lists[3].empty());
  }
}

}  // namespace
}  // namespace oriel
