#include "kernel/geometry/near_points.h"

#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

using exact::GridPoint;

/// The same by looking at every pair.
std::vector<int> group_pair_by_pair(const std::vector<GridPoint>& points, double reach) {
  DisjointSets groups(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double x = static_cast<double>(points[i][0] - points[j][0]),
                   y = static_cast<double>(points[i][1] - points[j][1]),
                   z = static_cast<double>(points[i][2] - points[j][2]);
      if (x * x + y * y + z * z < reach * reach)
        groups.unite(static_cast<int>(i), static_cast<int>(j));
    }
  std::vector<int> first;
  for (int i = 0; i < std::ssize(points); ++i) first.push_back(groups.find(i));
  return first;
}

/// Sorted points without doubles, some of them close together, in a box about the origin.
std::vector<GridPoint> any_points(std::int64_t size) {
  const auto coordinate = rc::gen::inRange<std::int64_t>(-size, size);
  auto points = *rc::gen::container<std::vector<GridPoint>>(
      rc::gen::map(rc::gen::tuple(coordinate, coordinate, coordinate), [](const auto& c) {
        return GridPoint{std::get<0>(c), std::get<1>(c), std::get<2>(c)};
      }));
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("near points are grouped as if every pair had been looked at") {
    CHECK(rc::check([] {
      const auto points = any_points(*rc::gen::element<std::int64_t>(4, 12, 60));
      const double reach = *rc::gen::element(1.0, 1.5, 3.0, 7.25, 20.0);
      const Numbers first = group_near_points(points, reach);
      const auto expected = group_pair_by_pair(points, reach);
      RC_ASSERT(std::ranges::equal(first, expected));
    }));
  }

  TEST_CASE("points that a chain of near points links are one group, known by its first") {
    std::vector<GridPoint> chain;
    for (std::int64_t i = 0; i < 100; ++i) chain.push_back({i, 2 * i, 0});
    const Numbers linked = group_near_points(chain, 2.5);
    CHECK(std::ranges::count(linked, 0) == 100);
    const Numbers apart = group_near_points(chain, 2.0);
    CHECK(std::ranges::is_sorted(apart, std::ranges::less_equal{}));
  }
}

}  // namespace
}  // namespace oriel::detail
