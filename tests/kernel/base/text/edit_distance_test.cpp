#include "kernel/base/text/edit_distance.h"

#include <algorithm>
#include <string>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

TEST_SUITE("kernel/base") {
  TEST_CASE("inserted deleted replaced and swapped characters are one edit each") {
    CHECK(edit_distance("height", "height") == 0);
    CHECK(edit_distance("heght", "height") == 1);
    CHECK(edit_distance("heiight", "height") == 1);
    CHECK(edit_distance("heijht", "height") == 1);
    CHECK(edit_distance("heihgt", "height") == 1);
    CHECK(edit_distance("", "height") == 6);
    CHECK(edit_distance("", "") == 0);
    // A swapped pair is not edited again.
    CHECK(edit_distance("ca", "abc") == 3);
  }

  TEST_CASE("the edits between two texts are the same both ways and none for the same text") {
    CHECK(rc::check([](const std::string& p, const std::string& q) {
      const std::size_t edits = edit_distance(p, q);
      RC_ASSERT(edits == edit_distance(q, p));
      RC_ASSERT((edits == 0) == (p == q));
      RC_ASSERT(edits <= std::max(p.size(), q.size()));
    }));
  }
}
