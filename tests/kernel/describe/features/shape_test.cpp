#include "kernel/describe/features/shape.h"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::standing_box;
using detail::StandingBox;

/// Turned in plan by the angle whose cosine is 0.8.
std::vector<Vec3> turned_in_plan(const std::vector<Vec3>& points) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back({0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z});
  return out;
}

void check_edges(const StandingBox& box, std::array<double, 3> edges) {
  for (std::size_t i = 0; i < 3; ++i) CHECK(box.edges()[i] == doctest::Approx(edges[i]));
}

TEST_SUITE("kernel/describe") {
  TEST_CASE("the standing box of the corners of a box is that box however it is turned") {
    const std::vector<Vec3> corners = {{1, 2, 0}, {4, 2, 0}, {4, 7, 0}, {1, 7, 0},
                                       {1, 2, 2}, {4, 2, 2}, {4, 7, 2}, {1, 7, 2}};
    const StandingBox box = standing_box(corners);
    CHECK(box.length == 5);
    CHECK(box.breadth == 3);
    CHECK(box.height == 2);
    CHECK(std::abs(box.along.y) == doctest::Approx(1));
    check_edges(standing_box(turned_in_plan(corners)), {5, 3, 2});
  }

  TEST_CASE("points within a box change nothing in its standing box") {
    std::vector<Vec3> points = {{2, 3, 1}, {1, 2, 0}, {4, 7, 0}, {4, 5, 1},
                                {1, 7, 2}, {4, 2, 1}, {3, 7, 0}};
    check_edges(standing_box(points), {5, 3, 2});
    points.erase(points.begin(), points.begin() + 1);
    check_edges(standing_box(points), {5, 3, 2});
  }

  TEST_CASE("the standing box of an upright rectangle or a line has no breadth") {
    check_edges(
        standing_box(std::vector<Vec3>{{0, 1, 0}, {3, 1, 0}, {3, 1, 2}, {0, 1, 2}, {1, 1, 2}}),
        {3, 2, 0});
    check_edges(standing_box(std::vector<Vec3>{{1, 0, 0}, {1, 3, 0}, {1, 3, 2}, {1, 0, 2}}),
                {3, 2, 0});
    check_edges(standing_box(std::vector<Vec3>{{1, 1, 0}, {1, 1, 2}}), {2, 0, 0});
    CHECK(standing_box(std::vector<Vec3>{{1, 0, 0}, {1, 3, 0}}).along == Vec3{0, 1, 0});
  }

  TEST_CASE("where a box lacks a corner a turned one may be smaller") {
    const std::vector<Vec3> triangle = {{0, 0, 0}, {2, 0, 1}, {1, 1, 0}};
    const StandingBox box = standing_box(triangle);
    CHECK(box.length * box.breadth == doctest::Approx(2));
    const std::vector<Vec3> square = {{1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 1}};
    check_edges(standing_box(square), {std::sqrt(2), std::sqrt(2), 1});
  }
}

}  // namespace
}  // namespace oriel
