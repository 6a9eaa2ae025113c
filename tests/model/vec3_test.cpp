#include "model/vec3.h"

#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

TEST_SUITE("model") {
  TEST_CASE("the area vector of a ring looks where the ring runs counter-clockwise") {
    const std::vector<Vec3> square{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
    CHECK(area_vector(square) == Vec3{0, 0, 4});
    CHECK(area_vector(square, std::vector<int>{3, 2, 1, 0}) == Vec3{0, 0, -4});
  }

  TEST_CASE("a ring with a dent counts what is inside") {
    const std::vector<Vec3> dented{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
    CHECK(area_vector(dented) == Vec3{0, 0, 10});
  }

  TEST_CASE("a ring of fewer than three points has no area") {
    CHECK(area_vector(std::vector<Vec3>{}) == Vec3{});
    CHECK(area_vector(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}) == Vec3{});
  }
}

}  // namespace
}  // namespace oriel
