#include "tests/cli/pages/ellipsis.h"

#include <doctest/doctest.h>

using oriel::test::fits;
using oriel::test::shown_again;

using Lines = std::vector<std::string>;

TEST_SUITE("cli") {
  TEST_CASE("an ellipsis on a page stands for any lines or any characters") {
    CHECK(fits({"a", "b"}, {"a", "b"}));
    CHECK(fits({"a"}, {"a  "}));
    CHECK_FALSE(fits({"a", "b"}, {"a", "c"}));
    CHECK_FALSE(fits({"a"}, {"a", "b"}));
    CHECK_FALSE(fits({"a", "b"}, {"a"}));
    CHECK(fits({"a", "…", "d"}, {"a", "b", "c", "d"}));
    CHECK(fits({"…", "d", "…"}, {"d"}));
    CHECK(fits({"…", "a", "b"}, {"a", "a", "b"}));
    CHECK_FALSE(fits({"a", "…", "d"}, {"a", "b", "c"}));
    CHECK(fits({"took … ms of … ms"}, {"took 12 ms of 40 ms"}));
    CHECK_FALSE(fits({"took … ms"}, {"took 12 s"}));
  }

  TEST_CASE("a block that is written again says what was printed and keeps its ellipses") {
    const Lines printed{"head", "f1 door 0.9", "f2 window 1", "f3 window 1", "2 doors in 12 ms"};
    CHECK(shown_again({"head", "…", "f3 window 2", "1 doors in … ms"}, printed) ==
          Lines{"head", "…", "f3 window 1", "2 doors in … ms"});
    CHECK(shown_again({"head", "f3 window 1", "…"}, printed) ==
          Lines{"head", "f1 door 0.9", "f2 window 1", "f3 window 1", "…"});
    CHECK(shown_again({"head", "…", "gone", "2 doors in 12 ms"}, printed) ==
          Lines{"head", "…", "2 doors in 12 ms"});
    CHECK(shown_again({"head", "…", "f1 door 0.9"}, {"head", "f1 door 1.0"}) ==
          Lines{"head", "f1 door 1.0"});
  }

  TEST_CASE("a block that is written again after all has changed shows both ends of a long text") {
    CHECK(shown_again({"x"}, {"a", "b"}) == Lines{"a", "b"});
    const Lines shown = shown_again({"x"}, Lines(100, "a"));
    CHECK(shown.size() == 16);
    CHECK(shown[12] == "…");
  }
}
