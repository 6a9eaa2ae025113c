#include "kernel/segment/sections/sweep.h"

#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/section.h"
#include "tests/support/houses.h"
#include "tests/support/solidified.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::Boundary;
using detail::World;

struct Counts {
  int asked = 0, answered = 0;
};

/// What a sweep says of a plane's section is what the section itself says.
void compare(const Boundary& body, int plane, int direction, const std::optional<double>& area,
             Counts& counts) {
  ++counts.asked;
  if (!area) return;
  ++counts.answered;
  detail::EdgeIndex edges(body, {plane});
  detail::Section section{plane, direction};
  section_at(body, section, edges.edges_at(0, direction), {});
  REQUIRE(section.loops.size() == 1);
  CHECK(std::abs(section.loops[0].area - *area) < detail::kSweptArea_m2);
  CHECK_FALSE(section.regions.at(0).is_natural);
}

Counts compare_all(const Building& building) {
  const Solid solid = test::solid_of(building, {});
  World world{detail::PlaneTable(solid.planes), detail::PointTable(solid, world.planes)};
  const Boundary body = boundary_of(solid, 0, world);
  Counts counts;
  for (int k = 0; k < world.planes.class_count(); ++k) {
    const auto& planes = world.planes.normal_class(k).planes;
    const auto passed = detail::sweep(body, k, planes);
    REQUIRE(passed.size() == planes.size());
    for (std::size_t i = 0; i < planes.size(); ++i) {
      compare(body, planes[i], 1, passed[i].in_front_m2, counts);
      compare(body, planes[i], -1, passed[i].behind_m2, counts);
    }
  }
  return counts;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a sweep says of a section what the section says") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(std::string(body.name));
      CHECK(compare_all(body.make()).asked > 0);
    }
  }

  TEST_CASE("a sweep answers for the planes beside the windows of a house") {
    const Counts counts = compare_all(test::six_pockets());
    CHECK(counts.answered * 2 > counts.asked);
  }

  TEST_CASE("a sweep answers nothing where a section is in two pieces") {
    const Building body = test::two_boxes_on_a_slab();
    const Solid solid = test::solid_of(body, {});
    World world{detail::PlaneTable(solid.planes), detail::PointTable(solid, world.planes)};
    const Boundary boundary = boundary_of(solid, 0, world);
    for (int k = 0; k < world.planes.class_count(); ++k) {
      if (world.planes.normal_class(k).normal != Vec3{0, 0, 1}) continue;
      // z = 0, 2 and 3: in front of 2 there are the two boxes.
      const auto passed = detail::sweep(boundary, k, world.planes.normal_class(k).planes);
      REQUIRE(passed.size() == 3);
      CHECK_FALSE(passed[1].in_front_m2);
      CHECK_FALSE(passed[2].behind_m2);
    }
  }
}

}  // namespace
}  // namespace oriel
