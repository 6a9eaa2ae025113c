#include "kernel/perturb/ear_clipping.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::clip_ears;
using detail::FlatCorner;

std::int64_t doubled_area(const std::vector<FlatCorner>& corners, const std::vector<int>& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const FlatCorner p = corners[static_cast<std::size_t>(ring[i])];
    const FlatCorner q = corners[static_cast<std::size_t>(ring[(i + 1) % ring.size()])];
    sum += p.u * q.v - q.u * p.v;
  }
  return sum;
}

/// Triangles are counter-clockwise, as many as there must be, and have the polygon's area.
void check_covers(const std::vector<FlatCorner>& corners,
                  const std::vector<std::vector<int>>& rings, std::uint64_t seed) {
  Random random(seed);
  const auto triangles = clip_ears(corners, rings, random);
  std::size_t entries = 0;
  std::int64_t expected = 0, found = 0;
  for (const auto& ring : rings) {
    entries += ring.size();
    expected += doubled_area(corners, ring);
  }
  CHECK(triangles.size() == entries + 2 * (rings.size() - 1) - 2);
  for (const auto& t : triangles) {
    CHECK(detail::is_counter_clockwise(corners, t));
    found += doubled_area(corners, {t.begin(), t.end()});
  }
  CHECK(found == expected);
}

TEST_SUITE("kernel/perturb") {
  TEST_CASE("triangles cover a polygon with holes and corners in a line") {
    // A wall of 10 × 6 with two windows and a corner in the middle of its lower side.
    const std::vector<FlatCorner> corners{{0, 0}, {5, 0}, {10, 0}, {10, 6}, {0, 6}, {1, 2}, {1, 4},
                                          {3, 4}, {3, 2}, {6, 2},  {6, 4},  {8, 4}, {8, 2}};
    const std::vector<std::vector<int>> rings{{0, 1, 2, 3, 4}, {5, 6, 7, 8}, {9, 10, 11, 12}};
    for (std::uint64_t seed = 0; seed < 50; ++seed) check_covers(corners, rings, seed);
  }

  TEST_CASE("coordinates of kilometres in micrometres do not overflow") {
    constexpr std::int64_t kFar = 4'000'000'000;
    const std::vector<FlatCorner> corners{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {0, 1}};
    Random random(1);
    CHECK(clip_ears(corners, {{0, 1, 2, 3}}, random).size() == 2);
  }

  TEST_CASE("rings that cross have no triangles or one that is turned round") {
    const std::vector<FlatCorner> bow{{0, 0}, {4, 4}, {4, 0}, {0, 4}};
    Random random(1);
    const auto triangles = clip_ears(bow, {{0, 1, 2, 3}}, random);
    CHECK(std::ranges::count_if(
              triangles, [&](const auto& t) { return detail::is_counter_clockwise(bow, t); }) < 2);
    CHECK(clip_ears(bow, {}, random).empty());
  }

  TEST_CASE("another seed cuts a polygon otherwise") {
    const std::vector<FlatCorner> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    std::vector<std::array<int, 3>> first;
    bool has_another = false;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Random random(seed);
      const auto triangles = clip_ears(square, {{0, 1, 2, 3}}, random);
      if (seed == 0) first = triangles;
      has_another = has_another || triangles != first;
    }
    CHECK(has_another);
  }
}

}  // namespace
}  // namespace oriel
