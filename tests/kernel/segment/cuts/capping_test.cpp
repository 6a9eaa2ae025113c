#include "kernel/segment/cuts/capping.h"

#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

namespace {

using oriel::Vec3;
using oriel::detail::least_cap_area;

constexpr double kSlack_m2 = 1e-9;

}  // namespace

TEST_SUITE("kernel/segment") {
  TEST_CASE("caps of a notch in an edge have the areas of its walls, seen from their planes") {
    const std::array<Vec3, 2> normals{Vec3{0, 0, 1}, Vec3{1, 0, 0}};
    CHECK(least_cap_area(normals, {2, 0, 3}, kSlack_m2) == doctest::Approx(5));
  }

  TEST_CASE("what no caps in these planes close has none") {
    const double none = std::numeric_limits<double>::infinity();
    const std::array<Vec3, 2> notch{Vec3{0, 0, 1}, Vec3{1, 0, 0}};
    CHECK(least_cap_area(notch, {2, 1, 3}, kSlack_m2) == none);   // open at a side
    CHECK(least_cap_area(notch, {-2, 0, 3}, kSlack_m2) == none);  // looks the other way
    const std::array<Vec3, 3> slot{Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}};
    CHECK(least_cap_area(slot, {0, 0, -3}, kSlack_m2) == none);
  }

  TEST_CASE("caps that look at each other count as little as they may") {
    const std::array<Vec3, 3> slot{Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}};
    CHECK(least_cap_area(slot, {0, 0, 3}, kSlack_m2) == doctest::Approx(3));
    CHECK(least_cap_area(slot, {0.5, 0, 3}, kSlack_m2) == doctest::Approx(3.5));
    const std::array<Vec3, 2> ring{Vec3{0, 0, 1}, Vec3{0, 0, -1}};
    CHECK(least_cap_area(ring, {}, kSlack_m2) == doctest::Approx(0));
  }

  TEST_CASE("of four planes the three that close most closely count") {
    const double half = std::sqrt(0.5);
    const std::array<Vec3, 4> normals{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1},
                                      Vec3{half, half, 0}};
    CHECK(least_cap_area(normals, {half, half, 2}, kSlack_m2) == doctest::Approx(3));
  }

  TEST_CASE("facets that are off their planes by the slack may be closed") {
    const std::array<Vec3, 2> notch{Vec3{0, 0, 1}, Vec3{1, 0, 0}};
    CHECK(least_cap_area(notch, {2, 0.05, 3}, 0.1) == doctest::Approx(5));
    CHECK(least_cap_area(notch, {-0.05, 0, 3}, 0.1) == doctest::Approx(3));
  }
}
