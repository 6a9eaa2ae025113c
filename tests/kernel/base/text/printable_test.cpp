#include "kernel/base/text/printable.h"

#include "kernel/base/issue.h"

#include <string>

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("kernel/base") {
  TEST_CASE("ordinary text is printed as it is") {
    for (const std::string text :
         {"", "NL.IMBAG.Pand.0503100000012345-0", "C:\\maps\\x1b.json", "Straße 7", "東京", "🏠",
          "\u0634\u0631\u06A9\u062A\u200C\u0647\u0627"})
      CHECK(printable(text) == text);
  }

  TEST_CASE("control characters are printed as escapes") {
    CHECK(printable("a\x1b[31mred") == "a\\x1b[31mred");
    CHECK(printable("a\x1b]0;title\x07") == "a\\x1b]0;title\\x07");
    CHECK(printable("one\ntwo\r\tthree\x7f") == "one\\ntwo\\r\\tthree\\x7f");
    CHECK(printable(std::string("a\0b", 3)) == "a\\x00b");
  }

  TEST_CASE("control characters beyond ASCII are printed as escapes") {
    CHECK(printable("a\xC2\x9B"
                    "2Jb") == "a\\u009b2Jb");
    CHECK(printable("\xC2\x85") == "\\u0085");
    CHECK(printable("\xC2\xA0") == "\xC2\xA0");
    CHECK(printable("a\x9B"
                    "2J") == "a\\x9b2J");
  }

  TEST_CASE("what turns the direction of writing is printed as escapes") {
    CHECK(printable("a\u202Eb\u202Cc") == "a\\u202eb\\u202cc");
    CHECK(printable("\u2066\u2067\u2068\u2069") == "\\u2066\\u2067\\u2068\\u2069");
    CHECK(printable("\u200E\u200F\u061C\u2028\u2029") == "\\u200e\\u200f\\u061c\\u2028\\u2029");
  }

  TEST_CASE("bytes that are not UTF-8 are printed as escapes") {
    CHECK(printable("a\xFF\xFE") == "a\\xff\\xfe");
    CHECK(printable("\xC0\x8A") == "\\xc0\\x8a");           // an overlong newline
    CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80");  // a surrogate
    CHECK(printable("\xE2\x80") == "\\xe2\\x80");           // cut off
  }

  TEST_CASE("lines stay lines and lose all other control characters") {
    CHECK(printable_lines("a\tb\nc\x1b[0m\r\n") == "a\tb\nc\\x1b[0m\\r\n");
  }

  TEST_CASE("what is printed of an issue is one line for all that ids and files say") {
    Issue issue;
    issue.code = Code::E101;
    issue.sentence = "the label 'a\nerror: E901 forged' is unknown";
    issue.place.file = "a\x1b[2J.json";
    issue.place.building = "b\r1";
    issue.place.feature = "f\u202E1";
    CHECK(to_string(issue) ==
          "a\\x1b[2J.json: b\\r1 f\\u202e1: E101 the label 'a\\nerror: E901 forged' is unknown");
  }
}
