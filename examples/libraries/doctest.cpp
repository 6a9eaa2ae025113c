// doctest: the tests. Names are sentences; doctest_discover_tests makes each a CTest test.
// Trap: a comma in a test's name breaks its CTest label.
// Trap: Approx allows about 1e-5 relative unless it is given an epsilon.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

TEST_SUITE("examples/libraries") {
  TEST_CASE("approx is coarse unless it is told otherwise") {
    const double volume_m3 = 1002.0;
    CHECK(volume_m3 == doctest::Approx(1002.009));
    CHECK(volume_m3 != doctest::Approx(1002.009).epsilon(1e-9));
  }

  TEST_CASE("a subcase runs the test case anew from its start") {
    int steps = 1;
    SUBCASE("up") { ++steps; }
    SUBCASE("down") { --steps; }
    CHECK(steps != 1);
  }
}
