#include "kernel/solidify/planes/coplanar_groups.h"

#include "kernel/solidify/noise.h"
#include "tests/support/changed.h"
#include "tests/support/solidified.h"
#include "tests/support/triangle_wall.h"

#include <doctest/doctest.h>

namespace oriel {

TEST_SUITE("kernel/solidify") {
  TEST_CASE("slivers along a row of windows join the wall and its piers, whatever the noise") {
    const Building exact = test::block_with_row(test::Slivers::kept);
    for (const double noise_m : {0.0, 0.0005, 0.001, 0.002})
      for (std::uint64_t seed = 0; seed < 50; ++seed) {
        CAPTURE(noise_m);
        CAPTURE(seed);
        Tolerances tolerances;
        tolerances.plane_offset_m = std::max(tolerances.plane_offset_m, 1.75 * noise_m);
        const Solid solid = test::solid_of(test::with_noise(exact, noise_m, seed), tolerances);
        // Six of the block and five of each pocket.
        CHECK(solid.facets.size() == 16);
        CHECK(volume_m3(solid) == doctest::Approx(12 * 8 * 3 - 2 * 0.3).epsilon(0.005));
      }
  }
}

}  // namespace oriel
