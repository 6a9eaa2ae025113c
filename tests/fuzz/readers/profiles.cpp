#include "interpret/plan/profile.h"
#include "tests/fuzz/targets.h"

#include <string>

namespace oriel::fuzz {

/// A profile: with one level, and the level of those that are built in.
void profiles(std::string_view bytes) {
  for (const char* level : {"", "2.0"}) {
    const auto profile = load_profile(std::string(bytes), "a.yaml", level);
    promise(profile.value.has_value() != has_errors(profile.issues),
            "a profile has a value or an error");
    for (const Issue& issue : profile.issues) (void)to_string(issue);
    if (!profile.value) continue;
    for (const double scale : {1.0, 5000.0}) (void)profile.value->thresholds(scale);
    (void)with_edge_min(*profile.value, 1);
  }
}

}  // namespace oriel::fuzz
