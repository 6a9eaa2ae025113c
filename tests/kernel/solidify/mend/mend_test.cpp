#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::outcome_of;

using Points = std::vector<Vec3>;

/// All polygons of two buildings in one.
Building together(Building first, const Building& second) {
  const int vertices = static_cast<int>(first.vertices.size());
  first.vertices.insert(first.vertices.end(), second.vertices.begin(), second.vertices.end());
  for (Polygon polygon : second.polygons) {
    for (auto& ring : polygon.rings)
      for (int& v : ring) v += vertices;
    polygon.source = static_cast<int>(first.polygons.size());
    first.polygons.push_back(std::move(polygon));
  }
  first.is_solid = false;
  return first;
}

Building box(Vec3 min, Vec3 max) { return BoxBody().add(min, max).build(); }

/// The building without the polygons that have all their points where `is_there` says.
template <class IsThere>
Building without(Building building, IsThere is_there) {
  std::erase_if(building.polygons, [&](const Polygon& polygon) {
    return std::ranges::all_of(polygon.rings[0], [&](int v) {
      return is_there(building.vertices[static_cast<std::size_t>(v)]);
    });
  });
  for (std::size_t i = 0; i < building.polygons.size(); ++i)
    building.polygons[i].source = static_cast<int>(i);
  return building;
}

struct Repaired {
  double volume_m3;
  std::size_t facets;
  RepairReport report;
};

/// What becomes of a building that can be repaired.
Repaired repaired(const Building& building, const RepairOptions& options = {}) {
  const Solidified out = solidify(building, {}, options);
  for (const Issue& issue : out.issues) CAPTURE(to_string(issue));
  REQUIRE(out.value.has_value());
  CHECK(is_closed(*out.value));
  CHECK(out.report.open_edges.empty());
  return {volume_m3(*out.value), out.value->facets.size(), out.report};
}

/// A cube of 2 m whose top is two polygons, and whose sides do not know the vertices between them.
Building cube_with_t_vertices() {
  return test::building_of({Points{{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}},
                            Points{{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}},
                            Points{{2, 0, 0}, {2, 2, 0}, {2, 2, 2}, {2, 0, 2}},
                            Points{{2, 2, 0}, {0, 2, 0}, {0, 2, 2}, {2, 2, 2}},
                            Points{{0, 2, 0}, {0, 0, 0}, {0, 0, 2}, {0, 2, 2}},
                            Points{{0, 0, 2}, {1, 0, 2}, {1, 2, 2}, {0, 2, 2}},
                            Points{{1, 0, 2}, {2, 0, 2}, {2, 2, 2}, {1, 2, 2}}});
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a closed shell is not repaired") {
    const Solidified out = solidify(box({0, 0, 0}, {3, 4, 5}));
    REQUIRE(out.value);
    CHECK_FALSE(out.report.was_needed);
    CHECK(out.issues.empty());
  }

  TEST_CASE("a polygon given twice is dropped whichever way round it runs") {
    for (const bool is_turned : {false, true}) {
      Building building = box({0, 0, 0}, {3, 4, 5});
      Polygon copy = building.polygons[1];
      copy.source = 6;
      if (is_turned) std::ranges::reverse(copy.rings[0]);
      building.polygons.push_back(copy);
      const Repaired out = repaired(building);
      CHECK(out.volume_m3 == doctest::Approx(60).epsilon(1e-9));
      CHECK(out.facets == 6);
      CHECK(out.report.duplicates.size() == 1);
    }
  }

  TEST_CASE("a vertex in the middle of the edges of neighbours is put into them") {
    const Repaired out = repaired(cube_with_t_vertices());
    CHECK(out.volume_m3 == doctest::Approx(8).epsilon(1e-9));
    CHECK(out.facets == 6);
    CHECK(out.report.t_vertices == 2);
    CHECK(out.report.dangling.empty());
  }

  TEST_CASE("two boxes with a common face are one body and the face is an inner one") {
    const Building building = together(box({0, 0, 0}, {2, 2, 2}), box({2, 0, 0}, {5, 2, 2}));
    const Repaired out = repaired(building);
    CHECK(out.volume_m3 == doctest::Approx(20).epsilon(1e-9));
    CHECK(out.facets == 6);
    CHECK(out.report.duplicates.size() == 1);
    CHECK(out.report.inner.size() == 1);
    CHECK(out.report.inner_area_m2 == doctest::Approx(4).epsilon(1e-9));
    CHECK(out.report.detached_shells == 0);
  }

  TEST_CASE("a wall that hangs on an edge is a dangling sheet and listed") {
    const Building fin = test::building_of({{{0, 0, 0}, {0, 0, 1}, {-1, 0, 1}, {-1, 0, 0}}});
    const Repaired out = repaired(together(box({0, 0, 0}, {1, 1, 1}), fin));
    CHECK(out.volume_m3 == doctest::Approx(1).epsilon(1e-9));
    CHECK(out.report.dangling == std::vector<int>{6});
    CHECK(out.report.dangling_area_m2 == doctest::Approx(1).epsilon(1e-9));
    CHECK(out.report.crowded_edges == 1);
  }

  TEST_CASE("a hole is closed up to the area that is allowed and the cap is reported") {
    const Building open =
        without(BoxBody().add({0, 0, 0}, {6, 6, 6}).remove({1, 0, 1}, {3, 1, 3}).build(),
                [](Vec3 p) { return p.y == 1 && p.x <= 3 && p.z <= 3; });
    CHECK(outcome_of(open, {}, {Closing::none, 10}) == "E302");
    CHECK(outcome_of(open, {}, {Closing::planar, 3.9}) == "E302");
    for (const RepairOptions options :
         {RepairOptions{Closing::planar, 4.1}, RepairOptions{Closing::any, 1}}) {
      const Repaired out = repaired(open, options);
      CHECK(out.volume_m3 == doctest::Approx(216 - 4).epsilon(1e-9));
      REQUIRE(out.report.caps.size() == 1);
      CHECK(out.report.caps[0].area_m2 == doctest::Approx(4).epsilon(1e-9));
      CHECK(length(out.report.caps[0].centre - Vec3{2, 1, 2}) < 1e-6);
    }
  }

  TEST_CASE("a facet of caps alone lists no polygons") {
    const Building open = without(box({0, 0, 0}, {2, 2, 2}), [](Vec3 p) { return p.z == 2; });
    const Solidified out = solidify(open);
    REQUIRE(out.value);
    CHECK(std::ranges::count_if(out.value->facets,
                                [](const Facet& f) { return f.polygons.empty(); }) == 1);
  }

  TEST_CASE("a strip that is missing round a corner is closed by two faces") {
    const auto is_in_strip = [](Vec3 p) { return p.z >= 1 && p.z <= 2 && (p.x == 4 || p.y == 4); };
    Building whole = BoxBody()
                         .add({0, 0, 0}, {4, 4, 1})
                         .add({0, 0, 1}, {4, 4, 2})
                         .add({0, 0, 2}, {4, 4, 3})
                         .build();
    // The walls of all three storeys are pieces of their own.
    Building open = without(whole, [&](Vec3 p) { return is_in_strip(p) && p.x == 4; });
    open = without(open, [&](Vec3 p) { return is_in_strip(p) && p.y == 4; });
    REQUIRE(open.polygons.size() + 2 == whole.polygons.size());
    const Repaired out = repaired(open);
    CHECK(out.volume_m3 == doctest::Approx(48).epsilon(1e-9));
    CHECK(out.report.caps.size() == 2);
  }

  TEST_CASE("a box without floor that stands on a roof is joined with it") {
    const Building chimney =
        without(box({1, 1, 2}, {1.5, 1.5, 4}), [](Vec3 p) { return p.z == 2; });
    const Repaired out = repaired(together(box({0, 0, 0}, {4, 4, 2}), chimney));
    CHECK(out.volume_m3 == doctest::Approx(32 + 0.5).epsilon(1e-9));
    CHECK(out.report.cut == 1);
    CHECK(out.report.caps.empty());
    CHECK(out.facets == 11);
  }

  TEST_CASE("a box inside another is left out or a cavity if it faces inward") {
    const Building fin = test::building_of({{{0, 0, 0}, {0, 0, 1}, {-1, 0, 1}, {-1, 0, 0}}});
    const Building outer = together(box({0, 0, 0}, {4, 4, 4}), fin);
    const Repaired full = repaired(together(outer, box({1, 1, 1}, {2, 2, 2})));
    CHECK(full.volume_m3 == doctest::Approx(64).epsilon(1e-9));
    CHECK(full.report.inner.size() == 6);

    Building inward = box({1, 1, 1}, {2, 2, 2});
    for (Polygon& polygon : inward.polygons) std::ranges::reverse(polygon.rings[0]);
    const Repaired hollow = repaired(together(outer, inward));
    CHECK(hollow.volume_m3 == doctest::Approx(63).epsilon(1e-9));
    CHECK(hollow.report.cavities == 1);
    CHECK(hollow.report.inner.empty());

    const Repaired apart = repaired(together(outer, box({6, 6, 1}, {7, 7, 2})));
    CHECK(apart.volume_m3 == doctest::Approx(65).epsilon(1e-9));
    CHECK(apart.report.detached_shells == 1);
  }

  TEST_CASE("a box inside another is a cavity wherever it stands though a polygon faces outward") {
    const Building fin = test::building_of({{{4, 0, 0}, {4, 0, 1}, {5, 0, 1}, {5, 0, 0}}});
    Building inward = box({0.2, 1, 1}, {2.2, 2, 2});
    for (Polygon& polygon : inward.polygons) {
      const bool is_turned = std::ranges::all_of(polygon.rings[0], [&](int v) {
        return inward.vertices[static_cast<std::size_t>(v)].x == 2.2;
      });
      if (!is_turned) std::ranges::reverse(polygon.rings[0]);
    }
    const Building body = together(together(box({0, 0, 0}, {4, 4, 4}), fin), inward);
    for (const double shift : {0.0, 10.0, 100.0}) {
      CAPTURE(shift);
      const Repaired hollow = repaired(test::mapped(body, [&](Vec3 p) {
        return p + Vec3{shift, shift, shift};
      }));
      CHECK(hollow.volume_m3 == doctest::Approx(64 - 2).epsilon(1e-9));
      CHECK(hollow.report.cavities == 1);
    }
  }

  TEST_CASE("a building that stays open lists its open edges") {
    const Building open = without(box({0, 0, 0}, {3, 4, 5}), [](Vec3 p) { return p.z == 5; });
    const Solidified out = solidify(open);
    CHECK_FALSE(out.value);
    REQUIRE(out.report.open_edges.size() == 4);
    double sum = 0;
    for (const OpenEdge& edge : out.report.open_edges) {
      CHECK(edge.from.z == 5);
      CHECK(edge.polygon >= 0);
      sum += length(edge.to - edge.from);
    }
    CHECK(sum == doctest::Approx(14).epsilon(1e-9));
  }

  /// A hall without ground, and at the lower edge of its wall a wedge without one end, into whose
  /// inside the wall runs: once the end is closed the wedge is all that is enclosed, and both sides
  /// of every wall of the hall are in it, as far as edges tell.
  Building hall_with_open_wedge() {
    const Building wedge = test::building_of(
        {Points{{5, 0, 0}, {5, -0.3, 0.3}, {5, 0.3, 0.3}},
         Points{{5, 0, 0}, {5.4, 0, 0}, {5.4, -0.3, 0.3}, {5, -0.3, 0.3}},
         Points{{5, 0, 0}, {5, 0.3, 0.3}, {5.4, 0.3, 0.3}, {5.4, 0, 0}},
         Points{{5, -0.3, 0.3}, {5.4, -0.3, 0.3}, {5.4, 0.3, 0.3}, {5, 0.3, 0.3}}});
    const Building hall = test::building_of(
        {Points{{0, 0, 0}, {5, 0, 0}, {5.4, 0, 0}, {20, 0, 0}, {20, 0, 8}, {0, 0, 8}},
         Points{{20, 0, 0}, {20, 10, 0}, {20, 10, 8}, {20, 0, 8}},
         Points{{20, 10, 0}, {0, 10, 0}, {0, 10, 8}, {20, 10, 8}},
         Points{{0, 10, 0}, {0, 0, 0}, {0, 0, 8}, {0, 10, 8}},
         Points{{0, 0, 8}, {20, 0, 8}, {20, 10, 8}, {0, 10, 8}}});
    return together(hall, wedge);
  }

  TEST_CASE("a closed hole that costs the walls that can be seen is no repair") {
    const Solidified out = solidify(hall_with_open_wedge(), {}, {Closing::planar});
    CHECK_FALSE(out.value);
    CHECK_FALSE(out.report.open_edges.empty());
    CHECK(out.report.inner.empty());
    CHECK(out.report.caps.empty());
    REQUIRE(out.issues.size() >= 1);
    CHECK(out.issues.back().code == Code::E302);
    CHECK(out.issues.back().sentence.find("can be seen from outside") != std::string::npos);
  }

  TEST_CASE("what is enclosed may be left out however large it is") {
    // Floors and partitions of a closed hall, more than its outside has.
    Building building = box({0, 0, 0}, {4, 4, 4});
    for (int i = 1; i < 20; ++i) {
      const double z = 0.2 * i;
      building =
          together(building, test::building_of({{{0, 0, z}, {4, 0, z}, {4, 4, z}, {0, 4, z}}}));
    }
    const Repaired out = repaired(building);
    CHECK(out.volume_m3 == doctest::Approx(64));
    CHECK(out.report.inner.size() == 19);
    CHECK(out.report.inner_area_m2 == doctest::Approx(19 * 16));
  }

  TEST_CASE("what is repaired does not depend on the order of the input") {
    const Building fin = test::building_of({{{0, 0, 2}, {0, 0, 3}, {-1, 0, 3}, {-1, 0, 2}}});
    const Building chimney =
        without(box({1, 1, 2}, {1.5, 1.5, 4}), [](Vec3 p) { return p.z == 2; });
    const Building building =
        test::in_order(together(together(cube_with_t_vertices(), fin), chimney));
    const Solidified first = solidify(building);
    REQUIRE(first.value);
    rc::check([&] {
      const auto seed = *rc::gen::arbitrary<std::uint64_t>();
      const Solidified out = solidify(test::in_order(test::shuffled(building, seed)));
      RC_ASSERT(out.value.has_value());
      RC_ASSERT(out.value->facets.size() == first.value->facets.size());
      RC_ASSERT(out.report.dangling.size() == first.report.dangling.size());
      RC_ASSERT(out.report.t_vertices == first.report.t_vertices);
      for (std::size_t v = 0; v < out.value->vertices.size(); ++v)
        RC_ASSERT(out.value->vertices[v].point == first.value->vertices[v].point);
    });
  }
}

}  // namespace
}  // namespace oriel
