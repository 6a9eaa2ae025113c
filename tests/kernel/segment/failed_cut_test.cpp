#include "tests/kernel/segment/invariants.h"
#include "tests/support/generated.h"
#include "tests/support/segmented.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/segment") {
  TEST_CASE("a cut whose rim separates nothing is not made and the rest goes on") {
    // Two millimetres of noise put vertices beside the planes that they count as lying on.
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

  TEST_CASE("a section without area is not cut and the rest goes on") {
    // In triangles with a millimetre of noise a section may come down to points.
    generator::Options options;
    options.seed = 77;
    options.noise = 1'000;
    options.triangulate = true;
    const test::Segmented s =
        test::segmented(test::generated(options, 27).building, Order::natural);
    double volume = 0;
    for (const Cell& cell : s.segmentation.cells) volume += cell.sign * cell.volume_m3;
    CHECK(volume == doctest::Approx(volume_m3(s.solid)).epsilon(1e-9));
  }
}

}  // namespace
}  // namespace oriel
