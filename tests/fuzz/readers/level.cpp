#include "generalise/series/level_state.h"
#include "io/levels/level_file.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

/// A level of a series whose building is called "a".
void level(std::string_view bytes) {
  const auto states = read_level(bytes, "a.1-1000.city.json", {"a"});
  promise(states.value || has_errors(states.issues), "a level has a value or an error");
  for (const Issue& issue : states.issues) (void)to_string(issue);
  if (!states.value) return;
  for (const LevelState& state : *states.value) {
    (void)labelled_building(state, {});
    (void)building_of(state, {});
  }
}

}  // namespace oriel::fuzz
