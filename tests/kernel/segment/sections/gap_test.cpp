#include "kernel/segment/sections/gap.h"

#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/section.h"
#include "tests/support/generated.h"
#include "tests/support/houses.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::Boundary;
using detail::Section;
using detail::World;

constexpr double kWeld_m = 0.001;

struct GapCounts {
  int sections = 0, told = 0;
};

/// The area by which the smallest region of a section is too large to be cut; 0 if one is natural.
double margin_of(const Section& section) {
  double least = std::numeric_limits<double>::infinity();
  for (const detail::Region& region : section.regions) {
    if (section.old_area(region) <= 0) continue;
    least = region.is_natural ? 0 : std::min(least, region.new_area - section.old_area(region));
    if (region.is_natural) break;
  }
  return least;
}

/// Makes the sections at both ends of every gap; what the one tells of the other must hold there.
GapCounts compare_gaps(const Building& building) {
  const Solid solid = test::solid_of(building, {});
  World world{detail::PlaneTable(solid.planes), detail::PointTable(solid, world.planes)};
  const Boundary body = boundary_of(solid, 0, world);
  const detail::SectionOptions options{ground_side(solid, world.planes, 0.5), kWeld_m};
  std::vector<int> planes(static_cast<std::size_t>(world.planes.size()));
  std::iota(planes.begin(), planes.end(), 0);
  detail::EdgeIndex edges(body, planes);
  GapCounts counts;
  for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
    if (world.planes.class_of(planes[i]) != world.planes.class_of(planes[i + 1])) continue;
    CHECK(edges.edges_at(i, 1).data() == edges.edges_at(i + 1, -1).data());
    Section front{planes[i], 1}, behind{planes[i + 1], -1};
    const bool do_cross_front = section_at(body, front, edges.edges_at(i, 1), options);
    const bool do_cross_behind = section_at(body, behind, edges.edges_at(i + 1, -1), options);
    counts.sections += 2;
    const double of_behind = do_cross_front ? margin_across_gap(body, front, planes[i + 1]) : 0;
    const double of_front = do_cross_behind ? margin_across_gap(body, behind, planes[i]) : 0;
    counts.told += (of_behind > 0 ? 1 : 0) + (of_front > 0 ? 1 : 0);
    if (of_behind > 0) CHECK(margin_of(behind) >= of_behind);
    if (of_front > 0) CHECK(margin_of(front) >= of_front);
  }
  return counts;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("what a section tells of the other end of its gap holds there") {
    int told = 0;
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(std::string(body.name));
      told += compare_gaps(body.make()).told;
    }
    CHECK(told > 0);
  }

  TEST_CASE("on houses a third of all sections is told by the one across the gap") {
    GapCounts all;
    generator::Options options;
    for (int seed = 1; seed <= 6; ++seed) {
      options.seed = static_cast<std::uint64_t>(seed);
      options.noise = 1'000 * (seed % 3);
      const GapCounts counts = compare_gaps(test::generated(options, seed).building);
      all.sections += counts.sections;
      all.told += counts.told;
    }
    CHECK(3 * all.told > all.sections);
  }

  TEST_CASE("a section tells nothing of a gap in which a vertex lies") {
    const Building body = test::two_boxes_on_a_slab();
    const Solid solid = test::solid_of(body, {});
    World world{detail::PlaneTable(solid.planes), detail::PointTable(solid, world.planes)};
    const Boundary boundary = boundary_of(solid, 0, world);
    for (int k = 0; k < world.planes.class_count(); ++k) {
      if (world.planes.normal_class(k).normal != Vec3{0, 0, 1}) continue;
      // z = 0, 2 and 3: of the planes 0 and 3 alone the gap has the vertices at 2 in it.
      const auto& all = world.planes.normal_class(k).planes;
      REQUIRE(all.size() == 3);
      detail::EdgeIndex edges(boundary, {all[0], all[2]});
      Section section{all[0], 1};
      CHECK_FALSE(section_at(boundary, section, edges.edges_at(0, 1), {-1, kWeld_m}));
    }
  }
}

}  // namespace
}  // namespace oriel
