#include "kernel/geometry/axis_corners.h"

#include "kernel/geometry/exact.h"

#include <doctest/doctest.h>

namespace oriel {

TEST_SUITE("kernel/geometry") {
  TEST_CASE("planes across the axes meet where exact arithmetic has them meet") {
    constexpr double kGrid_m = 0.125;
    const std::vector<Plane> planes{
        exact::make_plane({1, 0, 0}, 3, kGrid_m),  exact::make_plane({-1, 0, 0}, -5, kGrid_m),
        exact::make_plane({0, 1, 0}, -7, kGrid_m), exact::make_plane({0, -1, 0}, 0, kGrid_m),
        exact::make_plane({0, 0, 1}, 11, kGrid_m), exact::make_plane({0, 0, -1}, 13, kGrid_m),
        exact::make_plane({1, 1, 0}, 4, kGrid_m),  exact::make_plane({2, 0, 0}, 4, kGrid_m)};
    AxisCorners corners(kGrid_m);
    for (const Plane& plane : planes) corners.add(plane);
    int found = 0;
    for (int p = 0; p < 8; ++p)
      for (int q = 0; q < 8; ++q)
        for (int r = 0; r < 8; ++r) {
          const auto corner = corners.meeting(p, q, r);
          const auto plane = [&](int i) { return planes[static_cast<std::size_t>(i)]; };
          const bool is_across =
              p < 6 && q < 6 && r < 6 && p / 2 != q / 2 && q / 2 != r / 2 && r / 2 != p / 2;
          CHECK(corner.has_value() == is_across);
          if (!corner) continue;
          CHECK(*corner == exact::to_metres(*exact::meet(plane(p), plane(q), plane(r)), kGrid_m));
          ++found;
        }
    CHECK(found == 48);
  }
}

}  // namespace oriel
