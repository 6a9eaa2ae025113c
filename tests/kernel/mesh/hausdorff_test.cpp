#include "kernel/mesh/hausdorff.h"

#include "tests/kernel/mesh/meshes.h"

using namespace oriel;
using namespace oriel::test;

TEST_SUITE("kernel/mesh") {
  TEST_CASE("a solid is at no distance from itself") {
    const Solid box = solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).build());
    CHECK(hausdorff_m(box, box) <= 0.001);
  }

  TEST_CASE("a chimney is as far from the roof as it is high") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid bare = solid_of(body.build());
    const Solid with = solid_of(body.add({4, 4, 6}, {5, 5, 7.5}).build());
    CHECK(hausdorff_m(with, bare) == doctest::Approx(1.5).epsilon(0.001));
    CHECK(hausdorff_m(bare, with) == doctest::Approx(1.5).epsilon(0.001));
  }

  TEST_CASE("the bottom of a recess is as far from the filled wall as from the other sides") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid whole = solid_of(body.build());
    const Solid with = solid_of(body.remove({4, 0, 2}, {6, 5, 4}).build());
    // The middle of its bottom is 3 m from the floor, the top and the back wall.
    CHECK(hausdorff_m(whole, with) == doctest::Approx(3).epsilon(0.01));
  }
}
