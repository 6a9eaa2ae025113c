#include "kernel/solidify/supposed_solid.h"

#include "kernel/solidify/solidify.h"
#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::in_whole_facets;
using test::solid_of;

/// A house of 8 m × 6 m × 5 m with a window in its front, a door at the ground next to it, and a
/// balcony on its right side. One polygon a facet.
Building notched_house() {
  return in_whole_facets(BoxBody()
                             .add({0, 0, 0}, {8, 6, 5})
                             .remove({1, 0, 1}, {2, 0.2, 2.5})
                             .remove({4, 0, 0}, {5, 0.3, 2.1})
                             .add({8, 2, 3}, {9, 4, 3.5})
                             .build());
}

Building lacking(Building building, const std::set<int>& gone) {
  std::erase_if(building.polygons,
                [&](const Polygon& polygon) { return gone.contains(polygon.source); });
  building.is_solid = false;
  return building;
}

/// The polygons with all points where `is_there` says.
template <class IsThere>
std::set<int> polygons_at(const Building& building, IsThere is_there) {
  std::set<int> found;
  for (const Polygon& polygon : building.polygons)
    if (std::ranges::all_of(polygon.rings[0], [&](int v) {
          return is_there(building.vertices[static_cast<std::size_t>(v)]);
        }))
      found.insert(polygon.source);
  return found;
}

double supposed_m2(const SupposedSolid& supposed) {
  double sum = 0;
  for (const Cap& cap : supposed.faces) sum += cap.area_m2;
  return sum;
}

/// As large as the whole building, facet by facet, and all its polygons in it.
void check_whole(const Building& open, const Building& whole) {
  const auto supposed = supposed_solid(open);
  REQUIRE(supposed.has_value());
  const Solid solid = solid_of(whole);
  CHECK(is_closed(supposed->solid));
  CHECK(volume_m3(supposed->solid) == doctest::Approx(volume_m3(solid)).epsilon(1e-9));
  CHECK(surface_m2(supposed->solid) == doctest::Approx(surface_m2(solid)).epsilon(1e-9));
  CHECK(supposed->solid.facets.size() == solid.facets.size());
  std::set<int> listed;
  for (const Facet& facet : supposed->solid.facets)
    listed.insert(facet.polygons.begin(), facet.polygons.end());
  CHECK(listed.size() == open.polygons.size());
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("any one face of a house may be missing") {
    const Building house = notched_house();
    for (const Polygon& polygon : house.polygons) {
      CAPTURE(polygon.source);
      check_whole(lacking(house, {polygon.source}), house);
    }
  }

  TEST_CASE("any two faces of a house may be missing whether they meet or not") {
    const Building house = notched_house();
    for (const Polygon& one : house.polygons)
      for (const Polygon& other : house.polygons) {
        if (one.source >= other.source) continue;
        CAPTURE(one.source);
        CAPTURE(other.source);
        check_whole(lacking(house, {one.source, other.source}), house);
      }
  }

  TEST_CASE("a missing wall is one face with the holes of its windows and loses none of them") {
    const Building house = notched_house();
    const auto front = polygons_at(house, [](Vec3 p) { return p.y == 0; });
    REQUIRE(front.size() == 1);
    const auto supposed = supposed_solid(lacking(house, front));
    REQUIRE(supposed.has_value());
    REQUIRE(supposed->faces.size() == 1);
    CHECK(supposed->faces[0].area_m2 == doctest::Approx(40 - 1.5 - 2.1));
  }

  TEST_CASE("a house in pieces may lack pieces that meet in points only") {
    const Building house =
        BoxBody().add({0, 0, 0}, {8, 6, 5}).remove({1, 0, 1}, {2, 0.2, 2.5}).build();
    for (const int each : {7, 11, 13, 17}) {
      CAPTURE(each);
      std::set<int> gone;
      for (const Polygon& polygon : house.polygons)
        if (polygon.source % each == 0) gone.insert(polygon.source);
      const auto supposed = supposed_solid(lacking(house, gone));
      REQUIRE(supposed.has_value());
      CHECK(volume_m3(supposed->solid) == doctest::Approx(240 - 0.3));
      CHECK(supposed->solid.facets.size() == 11);
    }
  }

  TEST_CASE("three faces that meet in a corner may be missing with the corner") {
    const Building house = notched_house();
    const auto gone = polygons_at(
        house, [](Vec3 p) { return p.x <= 2 && p.x >= 1 && p.y <= 0.2 && p.z >= 1 && p.z <= 2.5; });
    // Pane and four reveals: without the pane, a side and the sill.
    std::set<int> three;
    for (const int p : gone) {
      const auto& ring = house.polygons[static_cast<std::size_t>(p)].rings[0];
      const auto all = [&](auto is) {
        return std::ranges::all_of(
            ring, [&](int v) { return is(house.vertices[static_cast<std::size_t>(v)]); });
      };
      if (all([](Vec3 q) { return q.y > 0.1; }) || all([](Vec3 q) { return q.x < 1.5; }) ||
          all([](Vec3 q) { return q.z < 1.5; }))
        three.insert(p);
    }
    REQUIRE(three.size() == 3);
    check_whole(lacking(house, three), house);
  }

  TEST_CASE("what is supposed does not depend on the order of vertices and polygons") {
    const Building house = notched_house();
    const Building open = test::in_order(lacking(house, {0, 3, 7}));
    const auto supposed = supposed_solid(open);
    REQUIRE(supposed.has_value());
    for (const unsigned seed : {1U, 2U, 3U}) {
      const auto again = supposed_solid(test::in_order(test::shuffled(open, seed)));
      REQUIRE(again.has_value());
      CHECK(volume_m3(again->solid) == volume_m3(supposed->solid));
      CHECK(supposed_m2(*again) == supposed_m2(*supposed));
    }
  }

  TEST_CASE("noise of corners is no reason to suppose nothing") {
    const Building house = notched_house();
    Tolerances tolerances;
    tolerances.plane_offset_m = 0.008;
    for (const std::set<int>& gone : {std::set<int>{0, 1}, {2, 5}, {4, 9}, {6, 11}}) {
      const auto supposed =
          supposed_solid(test::with_noise(lacking(house, gone), 0.004, 1), tolerances);
      REQUIRE(supposed.has_value());
      CHECK(volume_m3(supposed->solid) ==
            doctest::Approx(volume_m3(solid_of(house))).epsilon(0.01));
    }
  }

  TEST_CASE("a sheet is no building that lacks its back") {
    const Building front = test::building_of({{{0, 0, 0}, {8, 0, 0}, {8, 0, 5}, {0, 0, 5}}});
    CHECK_FALSE(supposed_solid(front).has_value());
    // Of a facade with a recess all faces but one would lie on it.
    const Building house = notched_house();
    std::set<int> others;
    for (const Polygon& polygon : house.polygons) others.insert(polygon.source);
    for (const int kept : polygons_at(house, [](Vec3 p) { return p.y < 1; })) others.erase(kept);
    CHECK_FALSE(supposed_solid(lacking(house, others)).has_value());
  }

  TEST_CASE("no more is supposed than there is") {
    const Building box = BoxBody().add({0, 0, 0}, {4, 4, 1}).build();
    // Four low walls without floor and roof.
    const auto level = polygons_at(box, [](Vec3 p) { return p.z == 0; });
    auto gone = polygons_at(box, [](Vec3 p) { return p.z == 1; });
    gone.insert(level.begin(), level.end());
    CHECK_FALSE(supposed_solid(lacking(box, gone)).has_value());
    CHECK(supposed_solid(lacking(box, level)).has_value());
  }

  TEST_CASE("a hole through which something runs is not closed") {
    Building house = lacking(BoxBody().add({0, 0, 0}, {4, 4, 4}).build(), {});
    std::erase_if(house.polygons, [&](const Polygon& polygon) {
      return std::ranges::all_of(polygon.rings[0], [&](int v) {
        return house.vertices[static_cast<std::size_t>(v)].z == 4;
      });
    });
    CHECK(supposed_solid(house).has_value());
    // A chimney that stands in the air of the room and reaches through the missing roof.
    const Building chimney = BoxBody().add({1, 1, 3}, {2, 2, 5}).build();
    const int vertices = static_cast<int>(house.vertices.size());
    house.vertices.insert(house.vertices.end(), chimney.vertices.begin(), chimney.vertices.end());
    for (Polygon polygon : chimney.polygons) {
      for (int& v : polygon.rings[0]) v += vertices;
      polygon.source = static_cast<int>(house.polygons.size()) + 10;
      house.polygons.push_back(std::move(polygon));
    }
    CHECK_FALSE(supposed_solid(house).has_value());
  }

  TEST_CASE("a hole is closed without loss where a smaller one would cost what lies in it") {
    // The front is missing but for what lies behind it: caps for each loop would close off window
    // and door.
    const Building house = notched_house();
    const auto front = polygons_at(house, [](Vec3 p) { return p.y == 0; });
    RepairOptions any;
    any.close = Closing::any;
    const Solidified closed = solidify(lacking(house, front), {}, any);
    REQUIRE(closed.value.has_value());
    CHECK(closed.report.inner.empty());
    CHECK(closed.report.caps.size() == 1);
    CHECK(volume_m3(*closed.value) == doctest::Approx(volume_m3(solid_of(house))));
    CHECK(test::outcome_of(lacking(house, front), {}, any) == "solid E316");
    CHECK(test::outcome_of(lacking(house, front), {}, {Closing::planar}) == "E302");
  }
}

}  // namespace
}  // namespace oriel
