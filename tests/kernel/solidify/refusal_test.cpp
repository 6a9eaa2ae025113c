#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::outcome_of;

/// The one error of a building, in words.
std::string error_of(const Building& building, const Tolerances& tolerances = {}) {
  const auto solid = solidify(building, tolerances);
  CHECK_FALSE(solid.value);
  std::string text;
  for (const Issue& issue : solid.issues)
    if (issue.severity == Severity::error) text += to_string(issue);
  return text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("fewer than four polygons enclose nothing") {
    CHECK(outcome_of(Building{}) == "E301");
    Building building = BoxBody().add({0, 0, 0}, {1, 1, 1}).build("shed");
    building.polygons.resize(3);
    CHECK(outcome_of(building) == "E301");
    CHECK(has(error_of(building), "shed: E301 3 polygons"));
  }

  TEST_CASE("an open shell is told with the number of its open edges and a place") {
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build("shed");
    std::erase_if(building.polygons, [&](const Polygon& polygon) {
      return std::ranges::all_of(polygon.rings[0], [&](int v) {
        return building.vertices[static_cast<std::size_t>(v)].z == 5;
      });
    });
    REQUIRE(building.polygons.size() == 5);
    CHECK(outcome_of(building) == "E302");
    const std::string error = error_of(building);
    CHECK(has(error, "shed: E302 not closed: 4 open edges in 1 loop"));
    CHECK(has(error, "5.000)"));
  }

  TEST_CASE("every single missing polygon of a body is found") {
    const Building whole = BoxBody().add({0, 0, 0}, {3, 4, 5}).remove({1, 1, 4}, {2, 2, 5}).build();
    for (std::size_t i = 0; i < whole.polygons.size(); ++i) {
      Building building = whole;
      building.polygons.erase(building.polygons.begin() + static_cast<std::ptrdiff_t>(i));
      CHECK(outcome_of(building, {}, {Closing::none, 0}) == "E302");
    }
  }

  TEST_CASE("a strip with a twist is not closed and no solid") {
    // A Möbius strip of five quads.
    std::vector<std::vector<Vec3>> quads;
    const auto rung = [](int i) {
      const double a = i * 2 * 3.14159265358979 / 5, half = i * 3.14159265358979 / 5;
      const Vec3 out{std::cos(a), std::sin(a), 0};
      const Vec3 tilt = std::cos(half) * Vec3{0, 0, 1} + std::sin(half) * out;
      return std::pair(5 * out + tilt, 5 * out - tilt);
    };
    for (int i = 0; i < 5; ++i) {
      auto [p, q] = rung(i);
      auto [r, s] = rung((i + 1) % 5);
      if (i == 4) std::swap(r, s);
      quads.push_back({p, q, s, r});
    }
    CHECK(outcome_of(test::building_of(quads)) == "E302");
  }

  TEST_CASE("polygons of a closed surface with one side cannot be oriented alike") {
    // A Klein bottle, cut into triangles.
    constexpr int kAround = 8, kAcross = 5;
    const auto point = [](int i, int j) {
      const double u = i * 2 * 3.14159265358979 / kAround, v = j * 2 * 3.14159265358979 / kAcross;
      const double r = 6 + 2 * (std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v));
      return Vec3{r * std::cos(u), r * std::sin(u),
                  2 * (std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v))};
    };
    std::vector<std::vector<Vec3>> triangles;
    for (int i = 0; i < kAround; ++i)
      for (int j = 0; j < kAcross; ++j) {
        const Vec3 p = point(i, j), q = point(i + 1, j), r = point(i + 1, j + 1);
        triangles.push_back({p, q, r});
        triangles.push_back({p, r, point(i, j + 1)});
      }
    CHECK(outcome_of(test::building_of(triangles)) == "E307");
  }

  TEST_CASE("a shell folded flat and a sheet of paper enclose nothing") {
    const Building folded = test::building_of({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                                               {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                               {{0, 1, 0}, {1, 0, 0}, {0, 0, 0}},
                                               {{0, 1, 0}, {1, 1, 0}, {1, 0, 0}}});
    const Building sheet = BoxBody().add({0, 0, 0}, {4, 4, 0.0015}).build();
    for (const Building& building : {folded, sheet}) {
      const std::string outcome = outcome_of(building);
      CHECK_FALSE(has(outcome, "solid"));
      CHECK(has(outcome, "E310"));
    }
  }

  TEST_CASE("a cavity outside its solid is refused") {
    Building building = BoxBody().add({0, 0, 0}, {1, 1, 1}).add({3, 0, 0}, {4, 1, 1}).build();
    building.is_solid = true;
    for (Polygon& polygon : building.polygons)
      if (building.vertices[static_cast<std::size_t>(polygon.rings[0][0])].x > 2) polygon.shell = 1;
    CHECK(has(outcome_of(building), "E305"));
  }

  TEST_CASE("a building beyond the exact range is refused with the range") {
    const Building building = BoxBody().add({0, 0, 0}, {5000, 10, 10}).build("long");
    CHECK(outcome_of(building) == "E501");
    CHECK(has(error_of(building), "long: E501 reaches 5000 m"));
    Tolerances coarse;
    coarse.weld_m = 0.01;
    CHECK(outcome_of(building, coarse) == "solid");
    Building nowhere = BoxBody().add({0, 0, 0}, {1, 1, 1}).build();
    nowhere.vertices[3].y = std::nan("");
    CHECK(outcome_of(nowhere) == "E501");
    nowhere.vertices[3].y = 1e300;
    CHECK(outcome_of(nowhere) == "E501");
  }

  TEST_CASE("nothing left after welding is told and not made up") {
    const Building building = BoxBody().add({0, 0, 0}, {0.0004, 0.0004, 0.0004}).build();
    const std::string outcome = outcome_of(building);
    CHECK(has(outcome, "E304"));
    CHECK(has(outcome, "E301"));
  }

  TEST_CASE("a one-sided surface with vertices in the edges of neighbours is refused") {
    // Three squares through the middle of an octahedron and every other of its faces: each edge has
    // two polygons, but no two sides are apart. The vertices that the faces have in the middle of
    // their edges keep neighbours apart until they are put into them.
    using Points = std::vector<Vec3>;
    const Vec3 e{3, 0, 0}, w{-3, 0, 0}, n{0, 3, 0}, s{0, -3, 0}, t{0, 0, 3}, b{0, 0, -3};
    std::vector<Points> polygons{{e, n, w, s}, {e, t, w, b}, {n, t, s, b}};
    for (const Points& face : {Points{e, n, t}, {w, s, t}, {w, n, b}, {e, s, b}}) {
      Points& with_middles = polygons.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        with_middles.push_back(face[i]);
        with_middles.push_back(0.5 * (face[i] + face[(i + 1) % 3]));
      }
    }
    CHECK(has(error_of(test::building_of(polygons)), "E302 no open edges"));
  }
}

}  // namespace
}  // namespace oriel
