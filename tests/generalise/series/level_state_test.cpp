#include "generalise/series/level_state.h"

#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

LevelState with_installations(const std::vector<std::string>& ids) {
  LevelState state;
  state.building = "house";
  for (const std::string& id : ids) state.installations[id] = {};
  return state;
}

TEST_SUITE("generalise") {
  TEST_CASE("states that differ have different hashes") {
    LevelState named = with_installations({"a", "b"}), counted = named;
    named.building = "other";
    counted.attributes["oriel_removed_window"] = std::int64_t{1};
    LevelState faceted = named;
    faceted.facets[{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}].type = "WallSurface";
    std::set<std::string> hashes;
    for (const LevelState& state :
         {with_installations({"a", "b"}), with_installations({"a|b"}), with_installations({"ab"}),
          with_installations({}), named, counted, faceted})
      CHECK(hashes.insert(hash_of(state)).second);
    CHECK(hash_of(with_installations({"a", "b"})) == hash_of(with_installations({"b", "a"})));
  }
}

}  // namespace
}  // namespace oriel
