#include "kernel/segment/sections/edge_index.h"

#include <cstddef>
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
}

}  // namespace
}  // namespace oriel
