#include "kernel/segment/sections/natural_chains.h"

#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/section.h"
#include "tests/support/generated.h"
#include "tests/support/houses.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using detail::Boundary;
using detail::World;

struct ChainCounts {
  int slots = 0, natural = 0, refused = 0;
};

/// Where a section has a natural region, the chains say that there may be one.
ChainCounts compare(const Building& building) {
  const Solid solid = test::solid_of(building, {});
  World world(solid);
  const Boundary body = boundary_of(solid, 0, world);
  const detail::PlaneSide ground = ground_side(solid, world.planes, 0.5);
  std::vector<int> planes;
  for (int plane = 0; plane < world.planes.size(); ++plane) planes.push_back(plane);
  detail::NaturalChains chains(body, planes, ground, true);
  chains.refresh();
  const std::int64_t done = world.work.done();
  CHECK(done > 0);
  chains.refresh();
  CHECK(world.work.done() == done);
  detail::EdgeIndex edges(body, planes);
  ChainCounts counts;
  for (std::size_t slot = 0; slot < 2 * planes.size(); ++slot) {
    detail::Section section{planes[slot / 2], slot % 2 == 0 ? 1 : -1};
    section_at(body, section, edges.edges_at(slot / 2, section.direction), {ground, 0.001, true});
    const bool is_natural = std::ranges::any_of(
        section.regions, [](const detail::Region& r) { return r.is_natural && r.is_candidate; });
    ++counts.slots;
    counts.natural += is_natural ? 1 : 0;
    counts.refused += chains.may_be_natural(slot) ? 0 : 1;
    if (is_natural) CHECK(chains.may_be_natural(slot));
  }
  return counts;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("where a natural region is there is a chain of edges") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(std::string(body.name));
      CHECK(compare(body.make()).slots > 0);
    }
  }

  TEST_CASE("a chain counts only where it runs around what can be cut") {
    // The outlines of the box run around material, and its facets look out, so air is all that can
    // be cut at them; that of the pocket does so at its wall, and not at its back.
    const Building building =
        test::BoxBody().add({0, 0, 0}, {8, 6, 8}).remove({2, 0, 2}, {4, 1, 5}).build();
    const Solid solid = test::solid_of(building, {});
    World world(solid);
    const Boundary body = boundary_of(solid, 0, world);
    std::vector<int> planes;
    for (int plane = 0; plane < world.planes.size(); ++plane) planes.push_back(plane);
    detail::NaturalChains chains(body, planes, -1, false);
    chains.refresh();
    int natural = 0;
    for (std::size_t slot = 0; slot < 2 * planes.size(); ++slot)
      natural += chains.may_be_natural(slot) ? 1 : 0;
    CHECK(natural == 1);
  }

  TEST_CASE("on houses chains say of most planes that nothing natural is there") {
    ChainCounts all;
    generator::Options options;
    for (int seed = 1; seed <= 6; ++seed) {
      options.seed = static_cast<std::uint64_t>(seed);
      options.noise = 1'000 * (seed % 3);
      const ChainCounts counts = compare(test::generated(options, seed).building);
      all.slots += counts.slots;
      all.natural += counts.natural;
      all.refused += counts.refused;
    }
    CHECK(all.natural > 20);
    CHECK(2 * all.refused > all.slots);
  }
}

}  // namespace
}  // namespace oriel
