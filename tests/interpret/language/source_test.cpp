#include "interpret/language/source.h"

#include <doctest/doctest.h>

using namespace oriel::rules;

TEST_SUITE("interpret") {
  TEST_CASE("places count lines and characters from one") {
    const Source source("f.yaml",
                        "ab\nc\xC3\xA4"
                        "de\n");
    CHECK(source.place(0).line == 1);
    CHECK(source.place(0).column == 1);
    CHECK(source.place(2).column == 3);
    CHECK(source.place(3).line == 2);
    CHECK(source.place(6).column == 3);
    CHECK(source.place(1000).line == 3);
    CHECK(source.place(1000).column == 1);
  }

  TEST_CASE("excerpts draw a caret below tabs and wide characters") {
    const Source source("f.yaml",
                        "\tc\xC3\xA4"
                        "de f\n");
    CHECK(source.excerpt({4, 6}) ==
          "\tc\xC3\xA4"
          "de f\n\t  ^~");
    CHECK(source.excerpt({1000, 1000}) == "\n^");
  }

  TEST_CASE("excerpts of very long lines are cut around the caret") {
    const auto line = [](int before, int after) {
      return std::string(before, 'x').append("HERE").append(after, 'y');
    };
    const std::string excerpt = Source("f.yaml", line(5000, 5000)).excerpt({5000, 5004});
    CHECK(excerpt == line(80, 36).append("\n").append(80, ' ').append("^~~~"));
  }

  TEST_CASE("bytes that are no UTF-8 are found") {
    CHECK(find_bad_byte("plain \t\r\n \xC3\xA4 \xE2\x89\xA4 \xF0\x9F\x8F\xA0") ==
          std::string_view::npos);
    CHECK(find_bad_byte("ab\xC3") == 2);
    CHECK(find_bad_byte("\xF5\x80\x80\x80") == 0);
    CHECK(find_bad_byte("\xE0\x80\x80") == 0);
    CHECK(find_bad_byte("a\x1b[0m") == 1);
    CHECK(find_bad_byte(std::string_view("\0", 1)) == 0);
  }
}
