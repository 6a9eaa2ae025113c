#include "kernel/attach/attach.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

Solid block() { return solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).build()); }

/// Planes of a box that look out of it, without the one whose normal is `without`.
std::vector<Plane> box_planes(const Solid& solid, Vec3 min, Vec3 max,
                              const std::vector<Vec3>& without) {
  std::vector<Plane> planes;
  for (const Vec3 n : {Vec3{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
    if (std::ranges::find(without, n) == without.end())
      planes.push_back(plane_through(solid, n, n.x + n.y + n.z > 0 ? max : min, 0.5));
  return planes;
}

constexpr Vec3 kFront{0, -1, 0}, kDown{0, 0, -1}, kUp{0, 0, 1};

Attached window(const Solid& solid, Vec3 min, Vec3 max, double clear_m = 0.1) {
  return attach(solid, {facet_looking(solid, kFront)}, box_planes(solid, min, max, {kFront}),
                Attach::sink, clear_m);
}

void check_volume(const Attached& made, double volume) {
  REQUIRE_MESSAGE(made.solid, made.reason);
  CHECK(is_closed(*made.solid));
  CHECK(volume_m3(*made.solid) == doctest::Approx(volume).epsilon(1e-6));
}

}  // namespace

TEST_SUITE("kernel/attach") {
  TEST_CASE("a box sunk into a wall takes its volume and adds five facets") {
    const auto made = window(block(), {2, 0, 1}, {3, 0.2, 2.5});
    check_volume(made, 480 - 0.3);
    CHECK(made.facets.size() == 5);
    CHECK(made.solid->facets.size() == 11);
  }

  TEST_CASE("a block stands on a sloping roof with a foot that follows it") {
    const Solid house = solid_of(gabled_house());
    FacetId roof;
    for (int f = 0; f < std::ssize(house.facets); ++f)
      if (const Vec3 n =
              house.planes[house.facets[static_cast<std::size_t>(f)].plane.index()].normal;
          n.z > 0.5 && n.y < 0)
        roof = {f};
    // Over y 1 to 2 the roof lies 6.75 to 7.5 m high, 7.125 m on the average.
    const auto made =
        attach(house, {roof}, box_planes(house, {3, 1, 0}, {4, 2, 9}, {kDown}), Attach::raise, 0.1);
    check_volume(made, volume_m3(house) + 9 - 7.125);
    CHECK(made.facets.size() == 5);
  }

  TEST_CASE("a door that reaches the ground cuts a notch into wall and ground") {
    const Solid solid = block();
    const auto made =
        attach(solid, {facet_looking(solid, kFront), facet_looking(solid, kDown)},
               box_planes(solid, {4, 0, 0}, {5, 0.2, 2}, {kFront, kDown}), Attach::sink, 0.1);
    check_volume(made, 480 - 0.4);
    CHECK(made.facets.size() == 4);
  }

  TEST_CASE("a sill wider than the window that it ends at runs on into the window") {
    const auto made = window(block(), {4, 0, 3}, {5, 0.2, 4});
    REQUIRE(made.solid);
    FacetId floor;
    for (const FacetId id : made.facets)
      if (made.solid->planes[made.solid->facets[id.index()].plane.index()].normal.z > 0) floor = id;
    const auto planes = box_planes(*made.solid, {3.9, -0.1, 2.9}, {5.1, 0, 3}, {{0, 1, 0}, kUp});
    Clearance clearance(0.3);
    const std::vector<FacetId> contacts{facet_looking(*made.solid, kFront), floor};
    CHECK_FALSE(attach(*made.solid, contacts, planes, Attach::raise, clearance).solid);
    clearance.own = made.facets;
    const auto sill = attach(*made.solid, contacts, planes, Attach::raise, clearance);
    check_volume(sill, 480 - 0.2 + 1.2 * 0.1 * 0.1);
    CHECK(sill.facets.size() == 4);
    CHECK(sill.solid->facets.size() == made.solid->facets.size() + 4);
  }

  TEST_CASE("a door that stands on a slab before its wall has the slab run into it") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).add({2, -2, 0}, {8, 0, 3}).build());
    FacetId wall, slab;
    for (int f = 0; f < std::ssize(solid.facets); ++f) {
      const Facet& facet = solid.facets[static_cast<std::size_t>(f)];
      const Plane& plane = solid.planes[facet.plane.index()];
      if (plane.normal == kFront && plane.offset_m == 0) wall = {f};
      if (plane.normal == kUp && plane.offset_m == 3) slab = {f};
    }
    const auto door =
        attach(solid, {wall, slab}, box_planes(solid, {4, 0, 3}, {5, 0.2, 5}, {kFront, kDown}),
               Attach::sink, 0.1);
    check_volume(door, 480 + 36 - 0.4);
    CHECK(door.facets.size() == 4);
    const auto frame =
        attach(solid, {wall, slab}, box_planes(solid, {4, -0.1, 3}, {5, 0, 5}, {{0, 1, 0}, kDown}),
               Attach::raise, 0.1);
    check_volume(frame, 480 + 36 + 0.2);
    CHECK(frame.facets.size() == 4);
  }

  TEST_CASE("a block before a wall on the ground has the ground run under it") {
    const Solid solid = block();
    const auto made =
        attach(solid, {facet_looking(solid, kFront), facet_looking(solid, kDown)},
               box_planes(solid, {4, -0.1, 0}, {5, 0, 2}, {{0, 1, 0}, kDown}), Attach::raise, 0.3);
    check_volume(made, 480 + 0.2);
    CHECK(made.facets.size() == 4);
  }

  TEST_CASE("a door may be less deep than its distance to other parts") {
    const Solid solid = block();
    const auto made =
        attach(solid, {facet_looking(solid, kFront), facet_looking(solid, kDown)},
               box_planes(solid, {4, 0, 0}, {5, 0.08, 2}, {kFront, kDown}), Attach::sink, 0.1);
    check_volume(made, 480 - 0.16);
  }

  TEST_CASE("what takes a place may come as near to other parts as what was there") {
    const Solid solid = block();
    const Clearance as_before(0.1, {{{0.05, 0, 1}, {2, 0, 1}, {2, 0, 2}, {0.05, 0, 2}}});
    const auto put = [&](Vec3 min, Vec3 max) {
      return attach(solid, {facet_looking(solid, kFront)}, box_planes(solid, min, max, {kFront}),
                    Attach::sink, as_before);
    };
    check_volume(put({0.05, 0, 1}, {3, 0.2, 2}), 480 - 0.59);
    CHECK_FALSE(put({0.03, 0, 1}, {3, 0.2, 2}).solid);
    CHECK_FALSE(put({0.05, 0, 0.05}, {3, 0.2, 2}).solid);
  }

  TEST_CASE("what comes too near to an edge or to another part is refused") {
    const Solid solid = block();
    CHECK_FALSE(window(solid, {0.05, 0, 1}, {3, 0.2, 2}).solid);
    CHECK_FALSE(window(solid, {2, 0, -1}, {3, 0.2, 2}).solid);
    CHECK_FALSE(window(solid, {2, 0, 1}, {3, 9, 2}).solid);
    CHECK_FALSE(window(solid, {2, 0, 1}, {3, 7.95, 2}).solid);
    const auto first = window(solid, {2, 0, 1}, {3, 0.2, 2});
    REQUIRE(first.solid);
    CHECK_FALSE(window(*first.solid, {3.05, 0, 1}, {4, 0.2, 2}).solid);
    CHECK_FALSE(window(*first.solid, {1, 0, 0.5}, {4, 0.2, 3}).solid);
    CHECK_FALSE(window(*first.solid, {2.2, 0, 1.2}, {2.8, 0.3, 1.8}).solid);
    check_volume(window(*first.solid, {3.2, 0, 1}, {4, 0.2, 2}), 480 - 0.2 - 0.16);
  }

  TEST_CASE("planes that bound no body are refused") {
    const Solid solid = block();
    auto planes = box_planes(solid, {2, 0, 1}, {3, 0.2, 2}, {kFront});
    planes.pop_back();
    CHECK_FALSE(attach(solid, {facet_looking(solid, kFront)}, planes, Attach::sink, 0.1).solid);
    CHECK_FALSE(attach(solid, {facet_looking(solid, kUp)},
                       box_planes(solid, {2, 2, 2}, {3, 3, 3}, {kDown}), Attach::raise, 0.1)
                    .solid);
  }
}
