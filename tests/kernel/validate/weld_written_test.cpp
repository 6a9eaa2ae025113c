#include "kernel/validate/weld_written.h"

#include "kernel/base/index.h"
#include "tests/kernel/validate/judged.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// As a file in millimetres has it, one polygon for each facet; vertices that become one are one.
Building in_millimetres(const Solid& solid) {
  Building building;
  std::vector<int> number_of;
  for (const Vertex& vertex : solid.vertices) {
    const auto whole = [](double metres) { return std::round(metres * 1000) / 1000; };
    const Vec3 p{whole(vertex.point.x), whole(vertex.point.y), whole(vertex.point.z)};
    const auto same =
        std::ranges::find_if(building.vertices, [&](Vec3 q) { return length(p - q) < 0.0005; });
    number_of.push_back(static_cast<int>(same - building.vertices.begin()));
    if (same == building.vertices.end()) building.vertices.push_back(p);
  }
  for (const Facet& facet : solid.facets) {
    Polygon polygon;
    polygon.source = static_cast<int>(building.polygons.size());
    for (const Loop& loop : facet.loops) {
      auto& ring = polygon.rings.emplace_back();
      for (const int v : loop) ring.push_back(number_of[at(v)]);
    }
    building.polygons.push_back(std::move(polygon));
  }
  return building;
}

/// A block of 10 x 10 x 5 m with a bevel of this height where its top meets its front.
Solid block_with_bevel(double height = 0.0002) {
  Solid solid = test::solid_of(test::BoxBody().add({0, 0, 0}, {10, 10, 5}).build());
  const std::size_t top = test::facet_looking(solid, {0, 0, 1}).index();
  const std::size_t front = test::facet_looking(solid, {0, -1, 0}).index();
  Loop ends;  // of the edge, as the front has it
  for (const int v : solid.facets[front].loops[0])
    if (solid.vertices[at(v)].point.z > 4) ends.push_back(v);
  REQUIRE(ends.size() == 2);
  const int first = static_cast<int>(solid.vertices.size());
  for (const int v : ends) {
    Vec3 lower = solid.vertices[at(v)].point;
    lower.z -= height;
    solid.vertices.push_back({lower, false});
  }
  for (int& v : solid.facets[front].loops[0])
    if (const auto found = std::ranges::find(ends, v); found != ends.end())
      v = first + static_cast<int>(found - ends.begin());
  // The sides get the lower corners beside the upper ones.
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    if (f == top || f == front) continue;
    Loop& loop = solid.facets[f].loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto found = std::ranges::find(ends, loop[i]);
      if (found == ends.end()) continue;
      const int lower = first + static_cast<int>(found - ends.begin());
      const Vec3 next = solid.vertices[at(loop[(i + 1) % loop.size()])].point;
      const bool goes_down = next.z < 4;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + (goes_down ? 1 : 0), lower);
      break;
    }
  }
  solid.shells[0].facets.push_back(FacetId{static_cast<int>(solid.facets.size())});
  Loop bevel{first, first + 1, ends[1], ends[0]};
  const Loop& below = solid.facets[front].loops[0];
  const auto at_first = std::ranges::find(below, first) - below.begin();
  if (below[static_cast<std::size_t>(at_first + 1) % below.size()] == first + 1)
    std::ranges::reverse(bevel);
  solid.facets.push_back({solid.facets[front].plane, {bevel}, {}});
  return solid;
}

}  // namespace

TEST_SUITE("kernel/validate") {
  TEST_CASE("corners that the file makes one point are one and a facet between them is gone") {
    const Solid solid = block_with_bevel();
    const Building written = in_millimetres(solid);
    const auto findings = validate(written);
    REQUIRE(std::ranges::find(findings, Code::E312, &Finding::code) != findings.end());
    const auto welded = weld_written(solid, written, findings);
    REQUIRE(welded);
    CHECK(welded->solid.facets.size() == 6);
    CHECK(welded->whole_of == std::vector{0, 1, 2, 3, 4, 5});
    CHECK(welded->solid.shells[0].facets.size() == 6);
    CHECK(validate(in_millimetres(welded->solid)).empty());
    std::set<int> corners;
    for (const Facet& facet : welded->solid.facets)
      corners.insert(facet.loops[0].begin(), facet.loops[0].end());
    CHECK(corners.size() == 8);
  }

  TEST_CASE("corners a millimetre apart may be one point to others and are one") {
    const Solid solid = block_with_bevel(0.001);
    const Building written = in_millimetres(solid);
    CHECK(validate(written).empty());
    const auto findings = test::for_any_judge(written);
    REQUIRE(std::ranges::find(findings, Code::E312, &Finding::code) != findings.end());
    const auto welded = weld_written(solid, written, findings);
    REQUIRE(welded);
    CHECK(welded->solid.facets.size() == 6);
    CHECK(test::for_any_judge(in_millimetres(welded->solid)).empty());
    CHECK(test::for_any_judge(in_millimetres(block_with_bevel(0.002))).empty());
  }

  TEST_CASE("a solid whose corners stay apart in the file is not welded") {
    const Solid solid = test::solid_of(test::BoxBody().add({0, 0, 0}, {10, 10, 5}).build());
    CHECK_FALSE(weld_written(solid, in_millimetres(solid), validate(in_millimetres(solid))));
  }
}

}  // namespace oriel
