#include "kernel/segment/sections/edge_index.h"

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("how many planes lie before a rank is the same looked up and searched for") {
    const std::vector<int> ranks = {3, 5, 11};
    detail::PlaneRanks looked_up, searched;
    for (const int rank : ranks) {
      looked_up.push_back(rank);
      searched.push_back(rank);
    }
    looked_up.make_table(6);     // ranks 1 to 11 are planes of the class
    searched.make_table(10000);  // far more than are asked for
    CHECK(looked_up.is_ready());
    CHECK(searched.is_ready());
    for (int rank = -1; rank < 20; ++rank) {
      std::size_t before = 0;
      for (const int other : ranks) before += other < rank ? 1 : 0;
      CAPTURE(rank);
      CHECK(looked_up.before(rank) == before);
      CHECK(searched.before(rank) == before);
    }
  }

  TEST_CASE("lists that outgrow their room hold what plain lists hold") {
    std::mt19937 random(3);
    for (const int most : {0, 1, 5}) {
      std::vector<int> rooms(20);
      for (int& room : rooms) room = static_cast<int>(random() % static_cast<unsigned>(most + 1));
      detail::GrowingLists<int> lists;
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
    detail::GrowingLists<int> lists;
    lists.make(std::vector<int>{2, 0, 1, 0});
    for (int number = 0; number < 7; ++number) lists.push_back(1, 2, number);
    const std::vector<int> all{0, 1, 2, 3, 4, 5, 6};
    CHECK(lists[0].empty());
    CHECK(std::ranges::equal(lists[1], all));
    CHECK(std::ranges::equal(lists[2], all));
    CHECK(lists[3].empty());
  }

  TEST_CASE("lists with room for what they get are filled in place") {
    detail::GrowingLists<int> lists;
    lists.make(std::vector<int>{1, 3, 2});
    lists.push_back_in_room(1, 2, 5);
    lists.push_back_in_room(0, 1, 6);
    lists.push_back_in_room(1, 2, 7);
    CHECK(std::ranges::equal(lists[0], std::vector<int>{6}));
    CHECK(std::ranges::equal(lists[1], std::vector<int>{5, 6, 7}));
    CHECK(std::ranges::equal(lists[2], std::vector<int>{5, 7}));
    lists.push_back(0, 2, 8);
    CHECK(std::ranges::equal(lists[1], std::vector<int>{5, 6, 7, 8}));
    CHECK(std::ranges::equal(lists[0], std::vector<int>{6, 8}));
  }
}

}  // namespace
}  // namespace oriel
