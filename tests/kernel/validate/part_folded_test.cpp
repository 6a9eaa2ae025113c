#include "kernel/validate/part_folded.h"

#include "kernel/base/index.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// One polygon for each facet, as a file has them.
Building written(const Solid& solid) {
  Building building;
  for (const Vertex& vertex : solid.vertices) building.vertices.push_back(vertex.point);
  for (const Facet& facet : solid.facets)
    building.polygons.push_back(
        {facet.loops, static_cast<int>(building.polygons.size()), 0, 0, {}});
  return building;
}

/// Puts vertices into the edge of a loop that runs from one place to another.
void put_into(const Solid& solid, Loop& loop, Vec3 from, Vec3 to, const std::vector<int>& more) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 a = solid.vertices[at(loop[i])].point;
    const Vec3 b = solid.vertices[at(loop[(i + 1) % loop.size()])].point;
    if (length(a - from) > 1e-9 || length(b - to) > 1e-9) continue;
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, more.begin(), more.end());
    return;
  }
  FAIL("no such edge");
}

/// A block of 10 × 10 × 5 m. In the edge between its top and its front stands a tip, 2 cm long, out
/// of both planes by 1 and 2 mm; `has_bevel`: below it is a facet of 2 cm, so that the tip has room
/// in it.
Solid block_with_tip(bool has_bevel) {
  Solid solid = test::solid_of(test::BoxBody().add({0, 0, 0}, {10, 10, 5}).build());
  const int first = static_cast<int>(solid.vertices.size());
  for (const Vec3 p :
       {Vec3{4.99, 0, 5}, Vec3{5, -0.001, 5.002}, Vec3{5.01, 0, 5}, Vec3{5, 0, 4.98}})
    solid.vertices.push_back({p, false});
  const std::size_t top = test::facet_looking(solid, {0, 0, 1}).index();
  const std::size_t front = test::facet_looking(solid, {0, -1, 0}).index();
  put_into(solid, solid.facets[top].loops[0], {0, 0, 5}, {10, 0, 5}, {first, first + 1, first + 2});
  put_into(solid, solid.facets[front].loops[0], {10, 0, 5}, {0, 0, 5},
           {first + 2, has_bevel ? first + 3 : first + 1, first});
  if (!has_bevel) {
    solid.vertices.pop_back();
    return solid;
  }
  for (const Loop& loop :
       {Loop{first, first + 3, first + 1}, Loop{first + 3, first + 2, first + 1}}) {
    solid.shells[0].facets.push_back(FacetId{static_cast<int>(solid.facets.size())});
    solid.facets.push_back({solid.facets[front].plane, {loop}, {}});
  }
  return solid;
}

TEST_SUITE("kernel/validate") {
  TEST_CASE("a facet that is folded as it is written is parted into ones that are not") {
    const Solid solid = block_with_tip(true);
    const auto findings = validate(written(solid));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == Code::E345);
    const auto parted = part_folded(solid, written(solid), findings);
    REQUIRE(parted);
    CHECK(validate(written(parted->solid)).empty());
    CHECK(is_closed(parted->solid));
    // The tip is a facet of its own, the rest of the top stays whole.
    REQUIRE(parted->solid.facets.size() == solid.facets.size() + 1);
    CHECK(parted->solid.shells[0].facets.size() == solid.facets.size() + 1);
    CHECK(parted->whole_of.back() == findings[0].polygon);
    CHECK(parted->solid.facets.back().loops[0].size() == 3);
    CHECK(parted->solid.facets.back().polygons == solid.facets[at(findings[0].polygon)].polygons);
    CHECK(volume_m3(parted->solid) == doctest::Approx(500).epsilon(1e-6));
  }

  TEST_CASE("a fold that two facets share is a sheet and goes") {
    const Solid solid = block_with_tip(false);
    const auto findings = validate(written(solid));
    REQUIRE(findings.size() == 2);
    const auto parted = part_folded(solid, written(solid), findings);
    REQUIRE(parted);
    CHECK(validate(written(parted->solid)).empty());
    CHECK(is_closed(parted->solid));
    CHECK(parted->solid.facets.size() == 6);
  }

  TEST_CASE("a solid in which something else is wrong is not parted") {
    const Solid solid = block_with_tip(true);
    auto findings = validate(written(solid));
    findings.back().code = Code::E352;
    CHECK_FALSE(part_folded(solid, written(solid), findings));
    CHECK_FALSE(part_folded(solid, written(solid), {}));
  }
}

}  // namespace
}  // namespace oriel
