#include "kernel/mesh/triangulate.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

namespace oriel::detail {
namespace {

using Rings = std::vector<std::vector<int>>;

/// Twice the area of triangles about `normal`; every one must be counter-clockwise.
double doubled_area(const std::vector<Vec3>& points,
                    const std::vector<std::array<int, 3>>& triangles, Vec3 normal) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](int i) { return points[static_cast<std::size_t>(i)]; };
    const double part = dot(cross(at(b) - at(a), at(c) - at(a)), normal);
    CHECK(part > 0);
    area += part;
  }
  return area;
}

/// A 4 × 4 m square with a 1 × 2 m hole, moved far out.
const std::vector<Vec3> kFlat{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                              {1, 1, 0}, {1, 3, 0}, {2, 3, 0}, {2, 1, 0}};

TEST_SUITE("io") {
  TEST_CASE("triangles cover a polygon with a hole in every direction") {
    const Rings rings{{0, 1, 2, 3}, {4, 5, 6, 7}};
    const double s = 1 / std::sqrt(2.0);
    for (const auto& [u, v] : {std::pair(Vec3{1, 0, 0}, Vec3{0, 1, 0}),
                               {{0, 1, 0}, {0, 0, 1}},
                               {{0, 0, 1}, {1, 0, 0}},
                               {{0, 1, 0}, {1, 0, 0}},
                               {{0, 0, 1}, {0, 1, 0}},
                               {{1, 0, 0}, {0, 0, 1}},
                               {{1, 0, 0}, {0, s, s}}}) {
      std::vector<Vec3> points;
      for (const Vec3 p : kFlat) points.push_back(Vec3{678114, 5403539, 414} + p.x * u + p.y * v);
      const auto triangles = triangulate(points, rings, cross(u, v));
      CHECK(triangles.size() == 8);
      CHECK(doubled_area(points, triangles, cross(u, v)) == doctest::Approx(28).epsilon(1e-8));
    }
  }

  TEST_CASE("points on an edge stay corners of triangles") {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    std::set<int> used;
    for (const auto& triangle : triangulate(points, {{0, 1, 2, 3, 4}}, {0, 0, 1}))
      used.insert(triangle.begin(), triangle.end());
    CHECK(used.size() == 5);
  }

  TEST_CASE("quickly, a quadrangle is cut from its first corner unless that would leave it") {
    const Vec3 up{0, 0, 1};
    const Rings ring{{0, 1, 2, 3}};
    const std::vector<Vec3> kite{{0, 0, 0}, {3, 1, 0}, {4, 4, 0}, {1, 3, 0}};
    using Triangles = std::vector<std::array<int, 3>>;
    CHECK(triangulate_quickly(kite, ring, up) == Triangles{{0, 1, 2}, {0, 2, 3}});
    for (const Vec3 corner : {Vec3{1, 1, 0}, {1.5, 0.5, 0}, {0.5, 0.5, 0}}) {
      // The second corner is turned inwards, or straight.
      std::vector<Vec3> other{{0, 0, 0}, corner, {3, 1, 0}, {0, 3, 0}};
      const auto triangles = triangulate_quickly(other, ring, up);
      CHECK(triangles == triangulate(other, ring, up));
      doubled_area(other, triangles, up);
    }
    CHECK(triangulate_quickly(kFlat, {{0, 1, 2, 3}, {4, 5, 6, 7}}, up).size() == 8);
  }

  TEST_CASE("a polygon whose edges cross falls back to a fan") {
    const std::vector<Vec3> points{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}};
    CHECK(triangulate(points, {{0, 1, 2, 3}}, {0, 0, 1}).size() == 2);
  }

  TEST_CASE("degenerate polygons have no triangles") {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    CHECK(triangulate(points, {{0, 1, 2, 3}}, {0, 0, 1}).empty());
    CHECK(triangulate(points, {}, {0, 0, 1}).empty());
  }
}

}  // namespace
}  // namespace oriel::detail
