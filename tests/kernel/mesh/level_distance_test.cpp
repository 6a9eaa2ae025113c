#include "kernel/mesh/level_distance.h"

#include "kernel/mesh/measures.h"
#include "tests/kernel/mesh/meshes.h"
#include "tests/support/shapes.h"

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::solid_of;

TEST_SUITE("kernel/mesh") {
  TEST_CASE("a level is at no distance from itself") {
    const Solid box = solid_of(BoxBody().add({0, 0, 0}, {4, 3, 2}).build());
    CHECK(level_distance_m(box, box) == 0);
  }

  TEST_CASE("levels are as far apart as any way of measuring says") {
    rc::check([] {
      BoxBody body;
      body.add({0, 0, 0}, {10, 8, 6});
      const Solid bare = solid_of(body.build());
      const auto in = [](int least, int most) { return 0.5 * *rc::gen::inRange(least, most); };
      const double x = in(2, 14), z = in(2, 8), deep = in(1, 6), high = in(1, 6);
      body.remove({x, 0, z}, {x + 1, deep, z + 1.5});
      body.add({x, 4, 6}, {x + 1, 5, 6 + high});
      const Solid with = solid_of(body.build());
      const double expected = hausdorff_m(bare, with, 0.002);
      RC_ASSERT(std::abs(level_distance_m(bare, with) - expected) <= 0.008);
      RC_ASSERT(std::abs(level_distance_m(with, bare) - expected) <= 0.008);
    });
  }

  TEST_CASE(
      "a wall that loses some holes and gains others is as far from itself as they are deep") {
    BoxBody one, other;
    for (BoxBody* body : {&one, &other}) body->add({0, 0, 0}, {10, 8, 6});
    for (const int x : {1, 3, 5}) one.remove({1.0 * x, 0, 2}, {x + 1.0, 0.5, 4});
    other.remove({1, 0, 2}, {2, 0.5, 4}).remove({7, 0, 1}, {8, 1.25, 2});
    const Solid a = solid_of(one.build()), b = solid_of(other.build());
    CHECK(level_distance_m(a, b) == doctest::Approx(hausdorff_m(a, b, 0.002)).epsilon(0.01));
    const LevelSurface first(a), second(b);
    CHECK(level_distance_m(first, second) == level_distance_m(a, b));
    CHECK(level_distance_m(second, first) == doctest::Approx(level_distance_m(a, b)).epsilon(0.01));
  }

  TEST_CASE("the farthest point may lie within a face") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    const Solid whole = solid_of(body.build());
    const Solid with = solid_of(body.remove({4, 0, 2}, {6, 5, 4}).build());
    CHECK(level_distance_m(whole, with) == doctest::Approx(3).epsilon(0.01));
  }
}

}  // namespace
}  // namespace oriel
