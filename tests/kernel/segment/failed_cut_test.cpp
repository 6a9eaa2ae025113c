#include "tests/kernel/segment/invariants.h"
#include "tests/support/generated.h"
#include "tests/support/segmented.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("a cut whose rim separates nothing is not made and the rest goes on") {
    // Two millimetres of noise put vertices beside the planes that they lie on by decree.
    generator::Options options;
    options.seed = 3;
    options.flush = 0.3;
    options.noise = 2'000;
    test::Exactness exactness;
    exactness.planarity_m = 0.012;
    exactness.has_sound_cells = false;
    test::check_segmentation(test::segmented(test::generated(options, 8).building, Order::natural),
                             exactness);
  }
}

}  // namespace
}  // namespace oriel
