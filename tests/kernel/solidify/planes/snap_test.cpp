#include "kernel/solidify/planes/snap.h"

#include "kernel/geometry/exact.h"

#include <cmath>

#include <doctest/doctest.h>

namespace oriel::detail {

namespace {

constexpr double kGridOfTest_m = 0.0009765625;  // 2^-10

Plane plane_across(std::array<std::int64_t, 3> normal, double offset_m) {
  return exact::make_plane(normal, std::llround(offset_m / kGridOfTest_m), kGridOfTest_m);
}

}  // namespace

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a point goes to where its planes meet and stays along what they leave free") {
    const std::vector<Plane> corner{plane_across({1, 0, 0}, 1), plane_across({0, 1, 0}, 2),
                                    plane_across({0, 0, 1}, 3)};
    const Vec3 start{1.01, 2.01, 2.98};
    CHECK(length(nearest_point(corner, start, 0.1) - Vec3{1, 2, 3}) < 1e-5);
    const Vec3 on_edge = nearest_point({corner[0], corner[1]}, start, 0.1);
    CHECK(length(on_edge - Vec3{1, 2, start.z}) < 1e-5);
  }

  TEST_CASE("planes that are almost parallel draw a point no further than its reach") {
    const std::vector<Plane> planes{plane_across({1000, 0, 0}, 1),
                                    plane_across({1000, 1, 0}, 1.01)};
    const Vec3 start{1, 0, 0};
    for (const double reach : {0.5, 0.05, 0.005})
      CHECK(length(nearest_point(planes, start, reach) - start) <= reach);
  }
}

}  // namespace oriel::detail
