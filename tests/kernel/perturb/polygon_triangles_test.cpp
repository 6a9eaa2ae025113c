#include "kernel/perturb/polygon_triangles.h"

#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

constexpr std::int64_t kMetre = 1'000'000;

/// A wall of 10 × 6 m with a window, its corners numbered with gaps.
const std::vector<std::vector<int>> kWall{{10, 12, 14, 16}, {20, 26, 24, 22}};

/// Where the corners are in the wall's own plane.
std::array<std::int64_t, 2> in_wall(int vertex) {
  const std::int64_t u = vertex == 12 || vertex == 14   ? 10
                         : vertex == 22 || vertex == 24 ? 4
                         : vertex >= 20                 ? 2
                                                        : 0;
  const std::int64_t v = vertex == 14 || vertex == 16   ? 6
                         : vertex == 24 || vertex == 26 ? 5
                         : vertex >= 20                 ? 1
                                                        : 0;
  return {u * kMetre, v * kMetre};
}

Vec3 in_space(const MicrometrePoint& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

TEST_SUITE("kernel/perturb") {
  TEST_CASE("triangles look where their polygon does in whatever direction that is") {
    // The wall's directions to the right and up, the first one slanted.
    const std::vector<std::array<MicrometrePoint, 2>> frames{
        {{{{1, 2, 0}}, {{0, 0, 1}}}},  {{{{-1, 2, 0}}, {{0, 0, 1}}}}, {{{{1, 0, 0}}, {{0, 1, 0}}}},
        {{{{1, 0, 0}}, {{0, -1, 1}}}}, {{{{0, 1, 0}}, {{0, 0, 1}}}},  {{{{0, -1, 0}}, {{0, 0, 1}}}},
        {{{{1, 0, 0}}, {{0, 0, 1}}}},  {{{{-1, 0, 0}}, {{0, 0, 1}}}}};
    for (const auto& [right, up] : frames) {
      const auto place_of = [&, &right = right, &up = up](int vertex) {
        const auto [u, v] = in_wall(vertex);
        MicrometrePoint p;
        for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = u * right[axis] + v * up[axis];
        return p;
      };
      const Vec3 normal = cross(in_space(right), in_space(up));
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        const auto triangles = detail::polygon_triangles(kWall, normal, place_of, random);
        CHECK(triangles.size() == 8);
        Vec3 sum;
        for (const auto& [a, b, c] : triangles) {
          const Vec3 p = in_space(place_of(a)), q = in_space(place_of(b)),
                     r = in_space(place_of(c));
          const Vec3 doubled_area = cross(q - p, r - p);
          CHECK(dot(doubled_area, normal) > 0);
          sum = sum + doubled_area;
        }
        // 10 m × 6 m without a window of 2 m × 4 m.
        const double expected = 2.0 * (60 - 8) * kMetre * kMetre;
        CHECK(length(sum - expected * normal) <= 1e-9 * length(sum));
      }
    }
  }

  TEST_CASE("a polygon that crosses itself has no triangles") {
    const auto place_of = [](int vertex) {
      return MicrometrePoint{{vertex % 2 * kMetre, vertex / 2 * kMetre, 0}};
    };
    Random random(1);
    CHECK(detail::polygon_triangles({{0, 3, 1, 2}}, {0, 0, 1}, place_of, random).empty());
    CHECK(detail::polygon_triangles({{0, 1}}, {0, 0, 1}, place_of, random).empty());
  }
}

}  // namespace
}  // namespace oriel
