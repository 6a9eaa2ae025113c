#include "kernel/geometry/exact.h"

#include <numeric>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel::exact {
namespace {

constexpr double kGrid_m = 1.0 / 1024;

using Normal = std::array<std::int64_t, 3>;

Plane plane(const Normal& normal, std::int64_t offset) {
  return make_plane(normal, offset, kGrid_m);
}

/// A component or coordinate of either sign up to `most`, small ones as often as large ones.
rc::Gen<std::int64_t> number(std::int64_t most) {
  return rc::gen::oneOf(rc::gen::inRange<std::int64_t>(-4, 5),
                        rc::gen::inRange<std::int64_t>(-most, most + 1));
}

Normal any_normal() {
  Normal normal{};
  for (auto& component : normal) component = *number(kMaxNormal);
  RC_PRE(normal != (Normal{0, 0, 0}));
  return normal;
}

GridPoint any_point() {
  GridPoint point{};
  for (auto& coordinate : point) coordinate = *number(kMaxCoordinate);
  return point;
}

TEST_SUITE("kernel/geometry") {
  TEST_CASE("points are rounded to the nearest grid point and come back as they were") {
    CHECK(round_to_grid({1, -2, 0.5}, kGrid_m) == GridPoint{1024, -2048, 512});
    CHECK(round_to_grid({0.4 / 1024, 0.6 / 1024, -0.6 / 1024}, kGrid_m) == GridPoint{0, 1, -1});
    CHECK(rc::check([] {
      const GridPoint point = any_point();
      RC_ASSERT(round_to_grid(to_metres(point, kGrid_m), kGrid_m) == point);
    }));
  }

  TEST_CASE("points are rounded as std::llround rounds") {
    const auto check = [](double value) {
      CAPTURE(value);
      CHECK(round_to_grid({value, -value, 0}, 1) ==
            GridPoint{std::llround(value), std::llround(-value), 0});
    };
    for (const double value :
         {0.0, 0.5, 1.5, 2.5, std::nextafter(0.5, 0.0), std::nextafter(0.5, 1.0),
          std::nextafter(2.5, 0.0), 4503599627370495.5, 4503599627370496.0, 9007199254740993.0,
          999999999999999.5, 1e15, 1e18})
      check(value);
    CHECK(rc::check([&] {
      const double value = static_cast<double>(*number(std::int64_t{1} << 40)) / 1024;
      RC_ASSERT(round_to_grid({value, 0, 0}, 1)[0] == std::llround(value));
    }));
  }

  TEST_CASE("fine rounding keeps what the grid cannot tell apart") {
    const Vec3 point{1.0 / 3, 2.0 / 7, -5.0 / 11};
    const Vec3 back = to_metres(round_finely(point, kGrid_m), kGrid_m);
    CHECK(length(back - point) < 1e-9);
  }

  TEST_CASE("a direction has no common divisor and points where the vector does") {
    CHECK(direction(Vector128{6, -9, 3}) == Normal{2, -3, 1});
    CHECK(direction(Vector128{0, 0, -1000}) == Normal{0, 0, -1});
    CHECK_FALSE(direction(Vector128{0, 0, 0}));
    CHECK(rc::check([] {
      const Normal normal = any_normal();
      const Int128 scale = *rc::gen::inRange<std::int64_t>(1, std::int64_t{1} << 40);
      const auto found =
          direction(Vector128{normal[0] * scale, normal[1] * scale, normal[2] * scale});
      RC_ASSERT(found.has_value());
      const std::int64_t divisor = std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
      for (std::size_t i = 0; i < 3; ++i) RC_ASSERT((*found)[i] * divisor == normal[i]);
    }));
  }

  TEST_CASE("a direction beyond the range is rounded to 28 bits") {
    const Int128 large = Int128{1} << 60;
    const auto found = direction(Vector128{large, large + 1, -large / 3});
    REQUIRE(found);
    for (const std::int64_t component : *found) CHECK(std::abs(component) <= kMaxNormal);
    const Vec3 n = plane(*found, 0).normal;
    CHECK(length(n - normalised({1, 1, -1.0 / 3})) < 1e-8);
  }

  TEST_CASE("numbers that need more than 64 bits give the same direction and the same metres") {
    CHECK(rc::check([] {
      constexpr std::int64_t kMost = std::int64_t{1} << 60;
      constexpr Int128 kScale = Int128{1} << 50;
      Vector128 small{}, large{};
      for (std::size_t i = 0; i < 3; ++i) {
        small[i] = *number(kMost);
        large[i] = small[i] * kScale;
      }
      RC_ASSERT(direction(small) == direction(large));
      const Int128 w = *rc::gen::inRange<std::int64_t>(1, kMost);
      RC_ASSERT(to_metres(Rational{small[0], small[1], small[2], w}, kGrid_m) ==
                to_metres(Rational{large[0], large[1], large[2], w * kScale}, kGrid_m));
    }));
  }

  TEST_CASE("a plane carries its doubles") {
    const Plane p = plane({0, 3, 4}, 5 * 1024);
    CHECK(length(p.normal - Vec3{0, 0.6, 0.8}) < 1e-15);
    CHECK(p.offset_m == doctest::Approx(1).epsilon(1e-15));
  }

  TEST_CASE("turning a plane round twice gives it back and swaps its sides") {
    CHECK(rc::check([] {
      const Plane p = plane(any_normal(), *number(std::int64_t{1} << 60));
      const Plane q = opposite(opposite(p));
      RC_ASSERT(q.coefficients == p.coefficients);
      RC_ASSERT(q.offset == p.offset);
      RC_ASSERT(q.normal == p.normal);
      const GridPoint point = any_point();
      RC_ASSERT(side(opposite(p), point) == -side(p, point));
    }));
  }

  TEST_CASE("planes of a box meet in its corner") {
    const auto corner = meet(plane({1, 0, 0}, 7), plane({0, -1, 0}, 3), plane({0, 0, 1}, 11));
    REQUIRE(corner);
    CHECK(as_grid_point(*corner) == GridPoint{7, -3, 11});
    CHECK(corner->w > 0);
  }

  TEST_CASE("parallel planes and planes round one line do not meet") {
    CHECK_FALSE(meet(plane({1, 0, 0}, 0), plane({-1, 0, 0}, 5), plane({0, 1, 0}, 0)));
    CHECK_FALSE(meet(plane({1, 0, 0}, 0), plane({0, 1, 0}, 0), plane({1, 1, 0}, 3)));
  }

  TEST_CASE("a meeting lies on its planes whatever their order and orientation") {
    CHECK(rc::check([] {
      const GridPoint point{*number(kMaxCoordinate), *number(kMaxCoordinate),
                            *number(kMaxCoordinate)};
      std::array<Plane, 3> planes;
      for (Plane& p : planes) {
        // Small normals, so that the offset of a plane through a far point stays in range.
        const Normal n{*number(1 << 20), *number(1 << 20), *number(1 << 20)};
        RC_PRE(n != (Normal{0, 0, 0}));
        p = plane(n, static_cast<std::int64_t>(dot(n, point)));
        RC_ASSERT(side(p, point) == 0);
      }
      const auto found = meet(planes[0], planes[1], planes[2]);
      RC_PRE(found.has_value());
      RC_ASSERT(as_grid_point(*found) == point);
      const auto turned = meet(opposite(planes[2]), planes[0], planes[1]);
      RC_ASSERT(turned.has_value());
      RC_ASSERT(as_grid_point(*turned) == point);
      for (const Plane& p : planes) RC_ASSERT(side(p, *found) == 0);
    }));
  }

  TEST_CASE("a meeting between grid points is on its planes exactly and is no grid point") {
    const Plane p = plane({3, 0, 0}, 1), q = plane({0, 7, 0}, 2), r = plane({0, 0, 11}, -5);
    const auto point = meet(p, q, r);
    REQUIRE(point);
    CHECK_FALSE(as_grid_point(*point));
    for (const Plane& s : {p, q, r}) CHECK(side(s, *point) == 0);
    CHECK(side(plane({1, 0, 0}, 0), *point) == 1);
    CHECK(side(plane({1, 0, 0}, 1), *point) == -1);
    CHECK(length(to_metres(*point, 1) - Vec3{1.0 / 3, 2.0 / 7, -5.0 / 11}) < 1e-15);
  }

  TEST_CASE("sides are told at the far end of the range where doubles cannot") {
    const Normal n{kMaxNormal, kMaxNormal - 1, -kMaxNormal};
    const GridPoint far{kMaxCoordinate, kMaxCoordinate, kMaxCoordinate};
    const auto offset = static_cast<std::int64_t>(dot(n, far));
    CHECK(side(plane(n, offset), far) == 0);
    CHECK(side(plane(n, offset - 1), far) == 1);
    CHECK(side(plane(n, offset + 1), far) == -1);
    const Rational thirds{Int128{far[0]} * 3, Int128{far[1]} * 3, Int128{far[2]} * 3 + 1, 3};
    CHECK(side(plane(n, offset), thirds) == -1);
  }
}

}  // namespace
}  // namespace oriel::exact
