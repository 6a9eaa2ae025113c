#include "kernel/geometry/planar.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel::detail {
namespace {

/// A plane with two directions in it, so that figures can be drawn in (u, v).
struct Drawing {
  Vec3 origin, u, v;
  [[nodiscard]] Vec3 normal() const { return cross(u, v); }
  [[nodiscard]] Vec3 at(double x, double y) const { return origin + x * u + y * v; }
  [[nodiscard]] Outline rectangle(double x0, double y0, double x1, double y1) const {
    return {at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)};
  }
  [[nodiscard]] Outline turned_rectangle(double x0, double y0, double x1, double y1) const {
    Outline outline = rectangle(x0, y0, x1, y1);
    std::ranges::reverse(outline);
    return outline;
  }
};

/// Planes of all sorts: along every axis, both ways, and oblique ones.
std::vector<Drawing> drawings() {
  std::vector<Drawing> all;
  for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 2, 3},
                       Vec3{-3, 1, 0.1}, Vec3{1, 1, 1}, Vec3{0.2, -5, 1}}) {
    const Vec3 unit = normalised(n);
    const auto [u, v] = axes_in(unit);
    all.push_back({{3, -4, 5}, u, v});
  }
  return all;
}

double area(std::span<const Outline> figure, Vec3 normal) {
  double sum = 0;
  for (const Outline& outline : figure) sum += signed_area(outline, normal);
  return sum;
}

TEST_SUITE("kernel/geometry") {
  TEST_CASE("areas are positive counter-clockwise and negative clockwise") {
    for (const Drawing& d : drawings()) {
      const Outline outline = d.rectangle(0, 0, 3, 2);
      CHECK(signed_area(outline, d.normal()) == doctest::Approx(6).epsilon(1e-12));
      CHECK(signed_area(outline, -d.normal()) == doctest::Approx(-6).epsilon(1e-12));
      CHECK(perimeter(outline) == doctest::Approx(10).epsilon(1e-12));
    }
    CHECK(signed_area({{0, 0, 0}, {1, 0, 0}}, {0, 0, 1}) == 0);
  }

  TEST_CASE("the area of an outline is the same from every start") {
    CHECK(rc::check([] {
      const auto d = drawings()[*rc::gen::inRange<std::size_t>(0, drawings().size())];
      Outline outline;
      for (int i = 0; i < *rc::gen::inRange(3, 12); ++i)
        outline.push_back(d.at(*rc::gen::inRange(-50, 50), *rc::gen::inRange(-50, 50)));
      const double before = signed_area(outline, d.normal());
      std::ranges::rotate(outline, outline.begin() + 1);
      RC_ASSERT(std::abs(signed_area(outline, d.normal()) - before) < 1e-9);
      std::ranges::reverse(outline);
      RC_ASSERT(std::abs(signed_area(outline, d.normal()) + before) < 1e-9);
    }));
  }

  TEST_CASE("a hole is outside its figure and an island in the hole is inside") {
    for (const Drawing& d : drawings()) {
      const std::vector<Outline> figure{d.rectangle(0, 0, 10, 10), d.turned_rectangle(2, 2, 8, 8),
                                        d.rectangle(4, 4, 6, 6)};
      CHECK(contains(figure, d.normal(), d.at(1, 5)));
      CHECK_FALSE(contains(figure, d.normal(), d.at(3, 5)));
      CHECK(contains(figure, d.normal(), d.at(5, 5)));
      CHECK_FALSE(contains(figure, d.normal(), d.at(11, 5)));
      CHECK(area(figure, d.normal()) == doctest::Approx(100 - 36 + 4).epsilon(1e-12));
    }
  }

  TEST_CASE("an interior point lies in the plane and inside the figure away from its rim") {
    for (const Drawing& d : drawings()) {
      const std::vector<std::vector<Outline>> figures{
          {d.rectangle(0, 0, 3, 2)},
          {d.rectangle(0, 0, 10, 10), d.turned_rectangle(1, 1, 9, 9)},
          {d.rectangle(0, 0, 10, 10), d.turned_rectangle(0.5, 0.5, 4, 9.5),
           d.turned_rectangle(5, 0.5, 9.5, 9.5)},
          {{d.at(0, 0), d.at(10, 0), d.at(10, 1), d.at(1, 1), d.at(1, 10), d.at(0, 10)}},
          {{d.at(0, 0), d.at(4, 8), d.at(-1, 3)}}};
      for (const auto& figure : figures) {
        const auto point = interior_point(figure, d.normal());
        REQUIRE(point);
        CHECK(contains(figure, d.normal(), *point));
        CHECK(std::abs(dot(d.normal(), *point - d.origin)) < 1e-9);
        for (const Vec3 shift : {0.1 * d.u, -0.1 * d.u}) {
          CHECK(contains(figure, d.normal(), *point + shift));
        }
      }
    }
  }

  TEST_CASE("an interior point is found where outlines run over each other in the tallest part") {
    for (const Drawing& d : drawings())
      for (const bool is_turned : {false, true}) {
        const std::vector<Outline> lying{d.rectangle(0, 0, 2, 5), d.turned_rectangle(0, 1, 2, 5)};
        const std::vector<Outline> upright{d.rectangle(0, 0, 5, 2), d.turned_rectangle(1, 0, 5, 2)};
        const auto& figure = is_turned ? upright : lying;
        const auto point = interior_point(figure, d.normal());
        REQUIRE(point);
        const Vec3 from = *point - d.origin;
        CHECK(dot(from, is_turned ? d.u : d.v) > 1e-3);
        CHECK(dot(from, is_turned ? d.u : d.v) < 1);
      }
  }

  TEST_CASE("empty outlines of a figure do not matter") {
    const Drawing d = drawings()[2];
    const std::vector<Outline> figure{{}, d.rectangle(0, 0, 3, 2), {}};
    const auto point = interior_point(figure, d.normal());
    REQUIRE(point);
    CHECK(contains(figure, d.normal(), *point));
    CHECK(std::abs(dot(d.normal(), *point - d.origin)) < 1e-9);
    CHECK_FALSE(interior_point(std::vector<Outline>{{}, {}}, d.normal()));
  }

  TEST_CASE("a figure without area has no interior point") {
    const Drawing d = drawings()[2];
    CHECK_FALSE(interior_point(std::vector<Outline>{}, d.normal()));
    CHECK_FALSE(
        interior_point(std::vector<Outline>{{d.at(0, 0), d.at(1, 0), d.at(2, 0)}}, d.normal()));
    CHECK_FALSE(
        interior_point(std::vector<Outline>{{d.at(0, 0), d.at(0, 1), d.at(0, 2)}}, d.normal()));
  }

  TEST_CASE("a face of a cube is a sixth of the sphere for its middle and turns with the eye") {
    for (const Drawing& d : drawings()) {
      const std::vector<Outline> face{d.rectangle(-1, -1, 1, 1)};
      const Vec3 unit = d.normal();
      CHECK(winding_part(face, d.origin - unit) == doctest::Approx(1.0 / 6).epsilon(1e-12));
      CHECK(winding_part(face, d.origin + unit) == doctest::Approx(-1.0 / 6).epsilon(1e-12));
      CHECK(winding_part(face, d.origin - 1e-6 * unit) == doctest::Approx(0.5).epsilon(1e-5));
    }
  }

  TEST_CASE("segments cross where both run through the other one by more than the slack") {
    for (const Drawing& d : drawings()) {
      const auto cross_at = [&](double x0, double x1, double slack_m) {
        return do_cross(d.at(x0, 0.5), d.at(x1, 0.5), d.at(0, 0), d.at(0, 1), d.normal(), slack_m);
      };
      CHECK(cross_at(-1, 1, 0));
      CHECK_FALSE(cross_at(1, 2, 0));
      CHECK_FALSE(cross_at(-2, -1, 0));
      CHECK(do_cross(d.at(0, 0), d.at(2, 2), d.at(0, 2), d.at(2, 0), d.normal()));
      CHECK_FALSE(do_cross(d.at(0, 0), d.at(2, 2), d.at(0, 2), d.at(0.5, 1.5), d.normal()));
      CHECK(cross_at(-0.5, 1, 0.4));
      CHECK_FALSE(cross_at(-0.5, 1, 0.6));
    }
  }

  TEST_CASE("a hole takes its part of the sphere away") {
    for (const Drawing& d : drawings()) {
      const Outline outer = d.rectangle(-2, -2, 2, 2), inner = d.turned_rectangle(-1, -1, 1, 0);
      const Vec3 eye = d.at(0.3, 0.7) - 1.5 * d.normal();
      const double ring = winding_part(std::vector<Outline>{outer, inner}, eye);
      CHECK(ring == doctest::Approx(winding_part(std::vector<Outline>{outer}, eye) +
                                    winding_part(std::vector<Outline>{inner}, eye))
                        .epsilon(1e-12));
      CHECK(winding_part(std::vector<Outline>{inner}, eye) < 0);
    }
  }
}

}  // namespace
}  // namespace oriel::detail
