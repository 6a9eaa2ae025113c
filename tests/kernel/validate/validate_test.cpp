#include "kernel/validate/validate.h"

#include "tests/kernel/validate/judged.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::codes_of;
using test::for_any_judge;

/// Four corners of a unit square at height z, counter-clockwise from above.
std::vector<Vec3> square(double z) { return {{0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z}}; }

Building surfaces(const std::vector<std::vector<Vec3>>& polygons) {
  Building building = test::building_of(polygons);
  building.is_solid = false;
  return building;
}

/// A square with a hole.
Building square_with_hole(const std::vector<Vec3>& hole) {
  Building building = surfaces({square(0), hole});
  building.polygons[0].rings.push_back(building.polygons[1].rings[0]);
  building.polygons.pop_back();
  return building;
}

/// Polygon 0 is the floor, a triangle; shafts at these x go down from the roof and through it, the
/// walls of the first from polygon 5 on.
Building prism_with_shafts(const std::vector<double>& xs) {
  const Vec3 a{0, 0, 0}, b{24, 0, 0}, c{0, 12, 0}, up{0, 0, 4};
  std::vector<std::vector<Vec3>> polygons{{a, c, b}, {a + up, b + up, c + up}};
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
    polygons.push_back({p, q, q + up, p + up});
  std::vector<std::vector<Vec3>> holes;
  for (const double x : xs) {
    const std::vector<Vec3> hole{{x, 1, 4}, {x, 2, 4}, {x + 1, 2, 4}, {x + 1, 1, 4}};
    const Vec3 down{0, 0, -5};
    std::vector<Vec3> bottom;
    for (std::size_t i = 0; i < hole.size(); ++i) {
      const Vec3 from = hole[i], to = hole[(i + 1) % hole.size()];
      polygons.push_back({to, from, from + down, to + down});
      bottom.insert(bottom.begin(), from + down);
    }
    polygons.push_back(bottom);
    holes.push_back(hole);
  }
  const auto count = static_cast<std::ptrdiff_t>(polygons.size());
  polygons.insert(polygons.end(), holes.begin(), holes.end());
  Building building = test::building_of(polygons);
  building.is_solid = true;
  for (auto hole = building.polygons.begin() + count; hole != building.polygons.end(); ++hole)
    building.polygons[1].rings.push_back(hole->rings[0]);
  building.polygons.erase(building.polygons.begin() + count, building.polygons.end());
  return building;
}

/// A block with two pits whose rims meet in the corner (2, 2). Each has a bottom of its own, or
/// they are one pit below the corner, in which two wedges of the block meet.
Building block_with_pits(bool are_joined) {
  const Vec3 v{2, 2, 0}, p1{2, 1, 0}, p2{1, 1, 0}, p3{1, 2, 0};
  const Vec3 q1{3, 2, 0}, q2{3, 3, 0}, q3{2, 3, 0};
  std::vector<std::vector<Vec3>> polygons{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}},
                                          {{0, 0, -4}, {0, 4, -4}, {4, 4, -4}, {4, 0, -4}},
                                          {{0, 0, -4}, {4, 0, -4}, {4, 0, 0}, {0, 0, 0}},
                                          {{4, 0, -4}, {4, 4, -4}, {4, 4, 0}, {4, 0, 0}},
                                          {{4, 4, -4}, {0, 4, -4}, {0, 4, 0}, {4, 4, 0}},
                                          {{0, 4, -4}, {0, 0, -4}, {0, 0, 0}, {0, 4, 0}}};
  const auto dig = [&](const std::vector<Vec3>& rim, Vec3 bottom) {
    for (std::size_t i = 0; i < rim.size(); ++i)
      polygons.push_back({rim[i], rim[(i + 1) % rim.size()], bottom});
  };
  if (are_joined) {
    const Vec3 w1{2.3, 1.7, -1}, w2{1.7, 2.3, -1};
    polygons.insert(polygons.end(), {{p1, v, w1}, {v, q1, w1}, {v, p3, w2}, {q3, v, w2}});
    dig({p2, p1, w1, q1, q2, q3, w2, p3}, {2, 2, -2});
  } else {
    dig({p2, p1, v, p3}, {1.5, 1.5, -1});
    dig({v, q1, q2, q3}, {2.5, 2.5, -1});
  }
  polygons.push_back({v, p1, p2, p3});
  polygons.push_back({v, q3, q2, q1});
  Building building = test::building_of(polygons);
  building.is_solid = true;
  for (int i = 0; i < 2; ++i) {
    building.polygons[0].rings.push_back(building.polygons.back().rings[0]);
    building.polygons.pop_back();
  }
  return building;
}

/// A prism over a star with so many points.
Building star_prism(int points) {
  std::vector<Vec3> low, high;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * i / points, radius = i % 2 == 0 ? 20 : 10;
    low.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    high.push_back(low.back() + Vec3{0, 0, 5});
  }
  std::vector<std::vector<Vec3>> polygons{{low.rbegin(), low.rend()}, high};
  for (std::size_t i = 0; i < low.size(); ++i) {
    const std::size_t next = (i + 1) % low.size();
    polygons.push_back({low[i], low[next], high[next], high[i]});
  }
  Building building = test::building_of(polygons);
  building.is_solid = true;
  return building;
}

TEST_SUITE("kernel/validate") {
  TEST_CASE("where rings of a polygon meet its parts around the corner count and not its rings") {
    CHECK(codes_of(block_with_pits(false)).empty());
    CHECK(codes_of(block_with_pits(true)) == "E350 303");
  }

  TEST_CASE("a box is valid wherever it stands and whatever is taken out of it") {
    const Building box = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    CHECK(validate(box).empty());
    CHECK(
        validate(BoxBody().add({0, 0, 0}, {3, 4, 5}).remove({1, 1, 4}, {2, 2, 5}).build()).empty());
    Building far = box;
    far.frame.origin_m = {680000, 5400000, 370};
    CHECK(validate(far).empty());
  }

  TEST_CASE("a hole may touch the outer ring in one point but not in two") {
    CHECK(codes_of(square_with_hole({{0, 2, 0}, {1, 3, 0}, {2, 2, 0}, {1, 1, 0}})).empty());
    CHECK(codes_of(square_with_hole({{0, 2, 0}, {2, 3, 0}, {4, 2, 0}, {2, 1, 0}})) == "E346 205");
    // Through the outer ring in its corner: the hole's point is on it, and its sides are not.
    CHECK(codes_of(square_with_hole({{4, 4, 0}, {5, 2, 0}, {2, 1, 0}, {2, 5, 0}})) == "E342 201");
  }

  TEST_CASE("vertices within the snapping tolerance are one and others are not") {
    Building building = surfaces({{{0, 0, 0}, {4, 0, 0}, {4, 0.0004, 0}, {4, 4, 0}, {0, 4, 0}}});
    CHECK(codes_of(building) == "E312 102");
    ValidateOptions fine;
    fine.snap_m = 1e-4;
    CHECK(validate(building, fine).empty());
  }

  TEST_CASE("vertices exactly the snapping tolerance apart are one if their doubles are closer") {
    // As val3dity computes it: from integer × scale + translate.
    int ones = 0;
    for (int y = 0; y < 100; ++y) {
      const double translate = 446000.5, before = y * 0.001 + translate,
                   after = (y + 1) * 0.001 + translate;
      Building building = surfaces({{{0, 0, 0}, {4, 0, 0}, {4, 0.001, 0}, {4, 4, 0}, {0, 4, 0}}});
      for (Vec3& vertex : building.vertices) vertex.y += 0.5 + y * 0.001;
      building.frame.origin_m = {85000, 446000, 0};
      const bool is_one = (after - before) * (after - before) < 0.001 * 0.001;
      ones += is_one ? 1 : 0;
      CAPTURE(y);
      CHECK(codes_of(building) == (is_one ? "E312 102" : ""));
      CHECK(for_any_judge(building).size() == 1);
    }
    CHECK(ones > 20);
    CHECK(ones < 100);
  }

  TEST_CASE("tolerances decide on planarity") {
    const Building bent = surfaces({{{0, 0, 0}, {4, 0, 0}, {4, 4, 0.06}, {0, 4, 0}}});
    CHECK(codes_of(bent) == "E344 203");
    ValidateOptions lax;
    lax.planarity_m = 0.1;
    CHECK(validate(bent, lax).empty());
    lax.planarity_deg = 0.1;
    const auto findings = validate(bent, lax);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].val3dity == 204);
  }

  TEST_CASE("what oriel writes has no two triangles of a polygon that are folded to each other") {
    // A floor with a flap of 2 cm on either side that rises by 15 degrees: 5 mm off its plane.
    const double width = 0.02, height = 0.0053;
    const auto floor_with_flaps = [&](double left, double right) {
      return surfaces({{{-width, 0, left},
                        {0, 0, 0},
                        {1, 0, 0},
                        {1 + width, 0, right},
                        {1 + width, 1, right},
                        {1, 1, 0},
                        {0, 1, 0},
                        {-width, 1, left}}});
    };
    CHECK(for_any_judge(floor_with_flaps(height, 0)).empty());
    CHECK(for_any_judge(floor_with_flaps(height, -height)).empty());
    CHECK(validate(floor_with_flaps(height, height)).empty());
    const auto findings = for_any_judge(floor_with_flaps(height, height));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == Code::E345);
  }

  TEST_CASE("a finding has its polygon and its place in the input's coordinates") {
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    building.frame.origin_m = {1000, 2000, 10};
    building.is_solid = true;
    building.polygons.erase(building.polygons.begin());
    const auto findings = validate(building);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == Code::E302);
    CHECK(findings[0].shell == 0);
    REQUIRE(findings[0].at_m.size() == 2);
    for (const Vec3 end : findings[0].at_m) {
      CHECK((end.x == 1000 || end.x == 1003));
      CHECK((end.y == 2000 || end.y == 2004));
    }
  }

  TEST_CASE("loose surfaces are judged as a shell only if that is asked for") {
    const Building open = surfaces({square(0), square(3)});
    CHECK(validate(open).empty());
    ValidateOptions options;
    options.primitive = ValidateOptions::Primitive::solid;
    CHECK(validate(open, options)[0].code == Code::E301);
    Building composite = open;
    composite.is_composite = true;
    CHECK(codes_of(composite) == "E351 305");
  }

  TEST_CASE("the order of polygons and where rings start change no code") {
    std::mt19937 random(7);
    for (const auto& [name, building] : test::error_buildings()) {
      CAPTURE(name);
      const std::string codes = codes_of(building);
      for (int i = 0; i < 5; ++i) {
        Building other = building;
        std::ranges::shuffle(other.polygons, random);
        other.repeats.clear();
        for (Polygon& polygon : other.polygons)
          for (auto& ring : polygon.rings)
            std::ranges::rotate(ring,
                                ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()));
        if (building.repeats.empty()) CHECK(codes_of(other) == codes);
      }
    }
  }

  TEST_CASE("of the polygons that one runs through the first is named wherever they stand") {
    std::vector<double> xs{2, 5, 8, 11, 14, 17};
    do {
      const auto findings = validate(prism_with_shafts(xs));
      REQUIRE_FALSE(findings.empty());
      CHECK(findings[0].code == Code::E352);
      CHECK(findings[0].polygon == 0);
      CHECK(findings[0].sentence.starts_with("polygon 0 meets polygon 5 "));
      std::ranges::rotate(xs, xs.begin() + 1);
    } while (xs[0] != 2);
  }

  TEST_CASE("coordinates that are none or far away are one finding") {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e308, -1e308, 1e10}) {
      Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
      building.vertices[3].y = bad;
      CHECK(codes_of(building) == "E506 0");
    }
  }

  TEST_CASE("nothing and empty rings are findings") {
    CHECK(codes_of(Building{}) == "E313 902");
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    building.polygons[0].rings.clear();
    building.polygons[1].rings = {{}};
    building.polygons[2].rings.emplace_back();
    CHECK(codes_of(building) == "E311 101, E311 101, E311 101");
  }

  TEST_CASE("ten thousand times the same polygon is soon judged") {
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    building.is_solid = true;
    for (int i = 0; i < 10'000; ++i) building.polygons.push_back(building.polygons[0]);
    const std::string codes = codes_of(building);
    CHECK(codes.starts_with("E303 303"));
    building.is_solid = false;
    CHECK(codes_of(building).empty());
    building.is_composite = true;
    CHECK(codes_of(building) == codes);
  }

  TEST_CASE("a thousand times the same solid is soon judged") {
    Building building = BoxBody().add({0, 0, 0}, {3, 4, 5}).build();
    building.is_solid = true;
    const std::size_t faces = building.polygons.size();
    for (int body = 1; body < 1000; ++body)
      for (std::size_t i = 0; i < faces; ++i) {
        building.polygons.push_back(building.polygons[i]);
        building.polygons.back().body = body;
      }
    CHECK(validate(building).empty());
    building.is_composite = true;
    const auto findings = validate(building);
    REQUIRE(findings.size() == 999);
    CHECK(findings[0].val3dity == 502);
  }

  TEST_CASE("a used up budget ends the judging and is the last finding") {
    Building building = star_prism(40);
    CHECK(codes_of(building).empty());
    ValidateOptions options;
    options.budget = 1;
    auto findings = validate(building, options);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == Code::E502);
    // What is found at any budget is true.
    building.vertices[0].z += 1;
    const std::size_t all = validate(building).size();
    for (options.budget = 1; options.budget < 1'000'000; options.budget *= 3) {
      findings = validate(building, options);
      const bool is_whole = findings.empty() || findings.back().code != Code::E502;
      CHECK(findings.size() <= all + (is_whole ? 0 : 1));
      if (is_whole) CHECK(findings.size() == all);
    }
  }

  TEST_CASE("a prism with a face of thousands of corners is judged within little work") {
    ValidateOptions options;
    options.budget = 4'000'000;
    CHECK(validate(star_prism(1000), options).empty());
  }

  TEST_CASE("bodies that touch within no budget are not judged further") {
    Building building = BoxBody().add({0, 0, 0}, {4, 4, 4}).build();
    const Building other = BoxBody().add({4, 0, 0}, {8, 4, 4}).build();
    const int first = static_cast<int>(building.vertices.size());
    building.vertices.insert(building.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Polygon polygon : other.polygons) {
      polygon.body = 1;
      polygon.source = static_cast<int>(building.polygons.size());
      for (auto& ring : polygon.rings)
        for (int& v : ring) v += first;
      building.polygons.push_back(std::move(polygon));
    }
    building.is_solid = building.is_composite = true;
    CHECK(codes_of(building).empty());
    ValidateOptions options;
    options.budget = 100'000;
    const auto findings = validate(building, options);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == Code::E502);
  }
}

}  // namespace
}  // namespace oriel
