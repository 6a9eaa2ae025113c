#include "generalise/series/change.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// A square of that size, in micrometres, on the ground.
MicrometreRing square(std::int64_t size) {
  return {{0, 0, 0}, {size, 0, 0}, {size, size, 0}, {0, size, 0}};
}

LevelState state_of(const LevelFacet& facet) {
  LevelState state;
  state.building = "house";
  state.facets[square(1000)] = facet;
  return state;
}

TEST_SUITE("generalise") {
  TEST_CASE("what two states differ in turns one into the other") {
    const LevelFacet wall{{}, "WallSurface", FeatureLabel{.id = "f1"}, {}, {}};
    LevelFacet roof = wall, named = wall, standing = wall, open = wall;
    roof.type = "RoofSurface";
    named.label = FeatureLabel{.id = "f2"};
    standing.installations = {"balcony"};
    open.holes = {square(10)};
    const std::vector<LevelFacet> all{wall, roof, named, standing, open};
    for (const LevelFacet& from : all)
      for (const LevelFacet& to : all) {
        LevelState state = state_of(from);
        CHECK(apply(state, difference(state, state_of(to))));
        CHECK(state == state_of(to));
      }
  }

  TEST_CASE("a facet that only gains a hole stays") {
    const LevelFacet whole{{}, "WallSurface", {}, {}, {}};
    LevelFacet open = whole;
    open.holes = {square(10)};
    const Change change = difference(state_of(whole), state_of(open));
    CHECK(change.removed.empty());
    CHECK(change.added.empty());
    REQUIRE(change.holes.size() == 1);
    CHECK(change.holes.begin()->second.added == open.holes);
  }

  TEST_CASE("a change does not fit a state without what it takes away") {
    const LevelFacet wall{{}, "WallSurface", {}, {}, {}}, roof{{}, "RoofSurface", {}, {}, {}};
    LevelState other = state_of(wall);
    other.facets = {{square(2000), wall}};
    CHECK_FALSE(apply(other, difference(state_of(wall), state_of(roof))));
    LevelState open = state_of(wall);
    open.facets.begin()->second.holes = {square(10)};
    LevelState whole = state_of(wall);
    CHECK_FALSE(apply(whole, difference(open, whole)));
  }
}

}  // namespace
}  // namespace oriel
