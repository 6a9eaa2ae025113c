#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/proof/valid_solid.h"
#include "tests/kernel/validate/judged.h"
#include "tests/support/generated.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include <doctest/doctest.h>

namespace oriel {
namespace {

bool is_proved(const Building& building) {
  const auto snapped = detail::snapped(building, ValidateOptions{}.snap_m, detail::SnapTies::two);
  return snapped && detail::is_surely_valid_solid(*snapped, ValidateOptions{});
}

/// Judged without the proof, which is not asked for the solids of a composite.
bool is_judged_valid(Building building) {
  building.is_composite = true;
  ValidateOptions options;
  options.primitive = ValidateOptions::Primitive::solid;
  return validate(building, options).empty();
}

/// One vertex, in some directions, by some millimetres, or onto another one's place along an axis.
Building with_moved_vertex(Building building, std::mt19937& random) {
  const auto one_of = [&](std::size_t size) { return random() % size; };
  Vec3& moved = building.vertices[one_of(building.vertices.size())];
  const Vec3 other = building.vertices[one_of(building.vertices.size())];
  constexpr std::array kBy_m{0.0, 0.0, 0.002, -0.003, 0.005, -0.3};
  const auto by = [&] { return kBy_m[one_of(kBy_m.size())]; };
  moved = moved + Vec3{by(), by(), by()};
  if (one_of(8) == 0) moved.x = other.x;
  if (one_of(8) == 0) moved.z = other.z;
  return building;
}

/// A face that is missing, turned, there twice, or has another one's corner.
Building with_faulty_face(Building building, std::mt19937& random) {
  const auto any = [&](auto& list) -> auto& { return list[random() % list.size()]; };
  Polygon& polygon = any(building.polygons);
  switch (random() % 4) {
    case 0:
      for (auto& ring : polygon.rings) std::ranges::reverse(ring);
      break;
    case 1:
      any(any(polygon.rings)) = any(any(any(building.polygons).rings));
      break;
    case 2:
      building.polygons.push_back(Polygon(polygon));
      break;
    default:
      building.polygons.erase(building.polygons.begin() +
                              static_cast<std::ptrdiff_t>(random() % building.polygons.size()));
  }
  return building;
}

TEST_SUITE("kernel/validate") {
  TEST_CASE("houses that are valid are proved to be") {
    for (int i = 0; i < 6; ++i) {
      CAPTURE(i);
      CHECK(is_proved(test::generated({}, i).building));
    }
    CHECK(is_proved(test::BoxBody().add({0, 0, 0}, {4, 4, 4}).build()));
  }

  TEST_CASE("what is proved to be valid is judged to be so") {
    for (const auto& [file, building] : test::error_buildings()) {
      CAPTURE(file);
      CHECK((!is_proved(building) || is_judged_valid(building)));
    }
    std::mt19937 random(7);
    int proved = 0, refuted = 0;
    for (int i = 0; i < 200; ++i) {
      CAPTURE(i);
      Building building = test::generated({}, i % 4).building;
      for (int moves = 0; moves <= i % 3; ++moves) building = with_moved_vertex(building, random);
      const bool is_valid = is_judged_valid(building);
      CHECK((!is_proved(building) || is_valid));
      proved += is_proved(building) ? 1 : 0;
      refuted += is_valid ? 0 : 1;
    }
    CHECK(proved > 5);
    CHECK(refuted > 50);
  }

  TEST_CASE("a body that is turned inside out is not proved to be valid") {
    Building building = test::BoxBody().add({0, 0, 0}, {4, 4, 4}).build();
    for (Polygon& polygon : building.polygons)
      for (auto& ring : polygon.rings) std::ranges::reverse(ring);
    CHECK(!is_proved(building));
  }

  TEST_CASE("a house with a faulty face is judged, if it is proved, to be valid") {
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
      CAPTURE(i);
      const Building faulty = with_faulty_face(test::generated({}, i % 6).building, random);
      CHECK((!is_proved(faulty) || is_judged_valid(faulty)));
    }
  }
}

}  // namespace
}  // namespace oriel
