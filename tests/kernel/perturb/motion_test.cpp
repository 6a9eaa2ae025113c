#include "kernel/perturb/motion.h"

#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

constexpr Vec3 kSomewhere{678123.25, 5403100.5, 372};

TEST_SUITE("kernel/perturb") {
  TEST_CASE("a motion goes back to where it came from") {
    const Motion motion(kSomewhere, 37.5, {0.3, -0.2, 0.1});
    const Vec3 point = kSomewhere + Vec3{4, -7, 3};
    CHECK(length(motion.before(motion.after(point)) - point) < 1e-8);
    CHECK(length(motion.after(motion.before(point)) - point) < 1e-8);
    CHECK(length(motion.after(point) - kSomewhere - Vec3{0.3, -0.2, 0.1}) ==
          doctest::Approx(length(point - kSomewhere)).epsilon(1e-9));
  }

  TEST_CASE("quarter turns are exact") {
    const Vec3 point = kSomewhere + Vec3{4, -7, 3};
    CHECK(Motion(kSomewhere, 90, {}).after(point) == kSomewhere + Vec3{7, 4, 3});
    CHECK(Motion(kSomewhere, -270, {}).after(point) == kSomewhere + Vec3{7, 4, 3});
    CHECK(Motion(kSomewhere, 540, {}).after(point) == kSomewhere + Vec3{-4, 7, 3});
    CHECK(Motion(kSomewhere, 720, {}).is_still());
    CHECK(Motion(kSomewhere, 720, {}).after(point) == point);
    CHECK_FALSE(Motion(kSomewhere, 0, {0, 0, 1}).is_still());
  }

  TEST_CASE("the box of what was turned is the one that it had") {
    const std::vector<Vec3> pane{kSomewhere + Vec3{1, 0, 1}, kSomewhere + Vec3{2, 1, 1},
                                 kSomewhere + Vec3{2, 1, 3}};
    const Motion motion(kSomewhere, 45, {});
    std::vector<Vec3> turned;
    for (const Vec3 p : pane) turned.push_back(motion.after(p));
    const Box box = box_before(motion, turned);
    CHECK(length(box.min - (kSomewhere + Vec3{1, 0, 1})) < 1e-8);
    CHECK(length(box.max - (kSomewhere + Vec3{2, 1, 3})) < 1e-8);
    CHECK(box_before(motion, {}).is_empty());
  }
}

}  // namespace
}  // namespace oriel
