#include "kernel/segment/cuts/slot_set.h"

#include <cstddef>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

std::vector<std::size_t> slots_between(const detail::SlotSet& set, std::size_t first,
                                       std::size_t last) {
  std::vector<std::size_t> slots;
  set.for_each(first, last, [&](std::size_t slot) { slots.push_back(slot); });
  return slots;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("slots of a set are visited in ascending order, those of a range alone too") {
    detail::SlotSet set(200);
    for (const std::size_t slot : {130, 0, 64, 63, 199}) set.insert(slot);
    CHECK(slots_between(set, 0, 200) == std::vector<std::size_t>{0, 63, 64, 130, 199});
    CHECK(slots_between(set, 63, 130) == std::vector<std::size_t>{63, 64});
    CHECK(slots_between(set, 1, 63).empty());
    CHECK(slots_between(detail::SlotSet(0), 0, 0).empty());
  }

  TEST_CASE("a slot may be taken out of its set while it is visited") {
    detail::SlotSet set(70);
    for (const std::size_t slot : {3, 4, 69}) set.insert(slot);
    std::size_t visits = 0;
    set.for_each([&](std::size_t slot) {
      ++visits;
      set.erase(slot);
    });
    CHECK(visits == 3);
    CHECK(slots_between(set, 0, 70).empty());
  }
}

}  // namespace
}  // namespace oriel
