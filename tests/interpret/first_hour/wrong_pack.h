#pragma once

#include "tests/interpret/support.h"

#include <string_view>
#include <vector>

namespace oriel::test {

/// What the author of a pack may do wrong in the first hour.
struct WrongPack {
  std::string_view fault;
  std::string_view text;
  /// All that is said of it, to the letter: the place, the cause and the remedy.
  std::string_view message;
};

/// Each pack is refused with its message alone: one fault gets one message.
inline void check_answers(const std::vector<WrongPack>& packs) {
  for (const WrongPack& pack : packs) {
    CAPTURE(pack.fault);
    const auto checked = load_pack(std::string(pack.text), "my_town.yaml");
    CHECK_FALSE(checked.value);
    CHECK(checked.issues.size() == 1);
    std::string said;
    for (const Issue& issue : checked.issues) said += to_string(issue) + "\n";
    CHECK(said == pack.message);
  }
}

}  // namespace oriel::test
