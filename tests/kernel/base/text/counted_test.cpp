#include "kernel/base/text/counted.h"

#include <cstddef>

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("kernel/base") {
  TEST_CASE("a noun follows its count") {
    CHECK(counted(0, "rule") == "0 rules");
    CHECK(counted(1, "rule") == "1 rule");
    CHECK(counted(std::size_t{2}, "rule") == "2 rules");
    CHECK(counted(1, "vertex", "vertices") == "1 vertex");
    CHECK(counted(3, "vertex", "vertices") == "3 vertices");
  }

  TEST_CASE("of several the noun goes with the number of all") {
    CHECK(counted_of(1, 1, "building") == "1 of 1 building");
    CHECK(counted_of(1, 2, "building") == "1 of 2 buildings");
    CHECK(counted_of(0, 0, "building") == "0 of 0 buildings");
  }

  TEST_CASE("a verb follows its count") {
    CHECK(agreeing(1, "is", "are") == "is");
    CHECK(agreeing(0, "is", "are") == "are");
  }

  TEST_CASE("a verb follows the count of several, or of one alone") {
    CHECK(agreeing_of(1, 2, "is", "are") == "is");
    CHECK(agreeing_of(0, 1, "is", "are") == "is");
    CHECK(agreeing_of(0, 2, "is", "are") == "are");
    CHECK(agreeing_of(0, 0, "is", "are") == "are");
  }
}
