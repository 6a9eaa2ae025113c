#include "kernel/attach/drop_facet.h"

#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

using Footprint = std::vector<Vec3>;

/// Walls of 6 m over a footprint, counter-clockwise.
Building prism(const Footprint& footprint) {
  constexpr Vec3 kWall{0, 0, 6};
  std::vector<std::vector<Vec3>> polygons{{footprint.rbegin(), footprint.rend()}, {}};
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    const Vec3 p = footprint[i], q = footprint[(i + 1) % footprint.size()];
    polygons.push_back({p, q, q + kWall, p + kWall});
    polygons[1].push_back(p + kWall);
  }
  return building_of(polygons);
}

Building moved_to(const Building& building, Vec3 x, Vec3 y) {
  Building out = building;
  for (Vec3& p : out.vertices) p = p.x * x + p.y * y + Vec3{0, 0, p.z};
  return out;
}

const double kSlant = std::sqrt(0.5);
/// A block of 10 x 8 x 6 m without one of its edges, by 0.25 m.
const Footprint kChamfered{{0, 0, 0}, {9.75, 0, 0}, {10, 0.25, 0}, {10, 8, 0}, {0, 8, 0}};
constexpr Vec3 kChamfer{1, -1, 0};

std::string reason_of(const Solid& solid, FacetId facet, double reach_m = 1) {
  const DroppedFacet dropped = drop_facet(solid, facet, reach_m);
  CHECK_FALSE(dropped.solid);
  return dropped.reason;
}

}  // namespace

TEST_SUITE("kernel/attach") {
  TEST_CASE("a strip at an edge goes and the walls beside it meet") {
    for (const auto& [x, y] : std::vector<std::pair<Vec3, Vec3>>{{{1, 0, 0}, {0, 1, 0}},
                                                                 {{0.8, 0.6, 0}, {-0.6, 0.8, 0}}}) {
      const Solid solid = solid_of(moved_to(prism(kChamfered), x, y));
      const Vec3 looking = kSlant * (kChamfer.x * x + kChamfer.y * y);
      const DroppedFacet dropped = drop_facet(solid, facet_looking(solid, looking), 0.3);
      REQUIRE_MESSAGE(dropped.solid, dropped.reason);
      CHECK(is_closed(*dropped.solid));
      CHECK(dropped.solid->facets.size() == 6);
      CHECK(dropped.solid->shells.at(0).facets.size() == 6);
      CHECK(dropped.solid->planes.size() == solid.planes.size());
      CHECK(volume_m3(*dropped.solid) == doctest::Approx(480).epsilon(1e-6));
    }
  }

  TEST_CASE("a strip in a corner goes as well") {
    const Solid solid = solid_of(prism(
        {{0, 0, 0}, {10, 0, 0}, {10, 4, 0}, {5.25, 4, 0}, {5, 4.25, 0}, {5, 8, 0}, {0, 8, 0}}));
    const DroppedFacet dropped = drop_facet(solid, facet_looking(solid, {kSlant, kSlant, 0}), 0.3);
    REQUIRE_MESSAGE(dropped.solid, dropped.reason);
    CHECK(is_closed(*dropped.solid));
    CHECK(volume_m3(*dropped.solid) == doctest::Approx(6 * (40 + 20)).epsilon(1e-9));
  }

  TEST_CASE("a corner that was cut off comes back") {
    constexpr double kCut = 0.25;
    const Vec3 a{10 - kCut, 0, 6}, b{10, kCut, 6}, c{10, 0, 6 - kCut};
    const Solid solid = solid_of(building_of({
        {{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}},
        {{0, 0, 6}, a, b, {10, 8, 6}, {0, 8, 6}},
        {{0, 0, 0}, {10, 0, 0}, c, a, {0, 0, 6}},
        {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, b, c},
        {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}},
        {{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}},
        {a, c, b},
    }));
    const FacetId triangle = facet_looking(solid, std::sqrt(1.0 / 3) * Vec3{1, -1, 1});
    const DroppedFacet dropped = drop_facet(solid, triangle, 0.3);
    REQUIRE_MESSAGE(dropped.solid, dropped.reason);
    CHECK(is_closed(*dropped.solid));
    CHECK(dropped.solid->facets.size() == 6);
    CHECK(volume_m3(*dropped.solid) == doctest::Approx(480).epsilon(1e-9));
    CHECK(reason_of(solid, triangle, 0.2) == "its neighbours meet too far away");
  }

  TEST_CASE("a facet does not go where those beside it cannot take its place") {
    const Solid block = solid_of(BoxBody().add({0, 0, 0}, {10, 8, 0.125}).build());
    CHECK(reason_of(block, facet_looking(block, {1, 0, 0})) == "its neighbours do not meet");
    const Solid windows =
        solid_of(BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({1, 0, 1}, {2, 0.25, 2}).build());
    CHECK(reason_of(windows, facet_looking(windows, {0, -1, 0})) == "it has holes");
    const Solid chamfered = solid_of(prism(kChamfered));
    CHECK(reason_of(chamfered, facet_looking(chamfered, {0, 0, 1})) == "it has 5 corners");
    CHECK(reason_of(chamfered, facet_looking(chamfered, kSlant * kChamfer), 0.2) ==
          "its neighbours meet too far away");
    const Solid gabled = solid_of(gabled_house());
    CHECK(reason_of(gabled, facet_looking(gabled, {0, 0, -1}), 1e3) != "");
  }

  TEST_CASE("a corner of four planes keeps its facets") {
    const Solid pyramid = solid_of(building_of({{{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}},
                                                {{0, 0, 0}, {4, 0, 0}, {2, 2, 3}},
                                                {{4, 0, 0}, {4, 4, 0}, {2, 2, 3}},
                                                {{4, 4, 0}, {0, 4, 0}, {2, 2, 3}},
                                                {{0, 4, 0}, {0, 0, 0}, {2, 2, 3}}}));
    CHECK(reason_of(pyramid, FacetId{1}, 9) == "more than three planes meet in one of its corners");
  }

  TEST_CASE("walls do not meet where something stands between them and the strip") {
    // A post of its own in front of the strip, behind the edge that is to come back.
    Building both = prism(kChamfered);
    const Building post = BoxBody().add({9.9375, 0.03125, 0}, {9.96875, 0.0625, 6}).build();
    for (Polygon polygon : post.polygons) {
      for (auto& ring : polygon.rings)
        for (int& v : ring) v += static_cast<int>(both.vertices.size());
      polygon.source = static_cast<int>(both.polygons.size());
      both.polygons.push_back(std::move(polygon));
    }
    both.vertices.insert(both.vertices.end(), post.vertices.begin(), post.vertices.end());
    const Solid solid = solid_of(both);
    CHECK(reason_of(solid, facet_looking(solid, kSlant * kChamfer)) == "something lies in its way");
  }
}
