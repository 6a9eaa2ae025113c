#include "model/tolerances.h"

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("model") {
  TEST_CASE("values tie by what the grid may move them and not by more than value_rel") {
    constexpr double kGrid_m = 0x1p-20;
    Tolerances tolerances;
    CHECK(tolerances.tie_rel(kGrid_m) == doctest::Approx(1e-5).epsilon(0.1));
    CHECK(tolerances.tie_rel(2 * kGrid_m) == 2 * tolerances.tie_rel(kGrid_m));
    for (const double value_rel : {1e-8, 1e-6, 1e-2}) {
      tolerances.value_rel = value_rel;
      CHECK(tolerances.tie_rel(kGrid_m) <= value_rel);
    }
    tolerances.value_rel = 0;
    CHECK(tolerances.tie_rel(kGrid_m) == 1e-9);
  }
}
