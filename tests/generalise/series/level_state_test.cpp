#include "generalise/series/level_state.h"

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
  TEST_CASE("states that differ in anything are different") {
    LevelState named = with_installations({"a", "b"}), counted = named;
    named.building = "other";
    counted.attributes["oriel_removed_window"] = std::int64_t{1};
    LevelState faceted = named;
    faceted.facets[{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}].type = "WallSurface";
    LevelState labelled = faceted, standing = with_installations({"a", "b"});
    labelled.facets.begin()->second.label = FeatureLabel{.id = "f1"};
    standing.installations["a"] = FeatureLabel{.score = 0.5};
    const std::vector<LevelState> all{with_installations({"a", "b"}),
                                      with_installations({"a|b"}),
                                      with_installations({"ab"}),
                                      with_installations({}),
                                      named,
                                      counted,
                                      faceted,
                                      labelled,
                                      standing};
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j) CHECK((all[i] == all[j]) == (i == j));
    CHECK(with_installations({"a", "b"}) == with_installations({"b", "a"}));
  }
}

}  // namespace
}  // namespace oriel
