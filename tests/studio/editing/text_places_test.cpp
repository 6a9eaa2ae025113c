#include "studio/editing/text_places.h"

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("studio/editing") {
  TEST_CASE("columns count units of UTF-16") {
    const std::string text = "a\n\xC3\xA9 \xF0\x9F\x8F\xA0 b\r\nc";
    const TextPlaces places(text);
    CHECK(places.place(text.find('b')) == TextPlace{2, 6});
    CHECK(places.offset({2, 6}) == text.find('b'));
    CHECK(places.line_count() == 3);
    for (std::size_t i = 0; i <= text.size(); ++i) {
      const bool is_inside = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
      const bool is_line_end = i > 0 && text[i] == '\n' && text[i - 1] == '\r';
      if (!is_inside && !is_line_end) CHECK(places.offset(places.place(i)) == i);
    }
  }

  TEST_CASE("places beyond a line or the text mean its end") {
    const std::string text = "ab\ncd";
    const TextPlaces places(text);
    CHECK(places.offset({1, 99}) == 2);
    CHECK(places.offset({9, 1}) == 5);
    CHECK(places.offset({0, 7}) == 0);
    CHECK(places.offset({-1, -1}) == 0);
    CHECK(places.place(99) == TextPlace{2, 3});
  }

  TEST_CASE("edits are made at the places of the text as it was") {
    CHECK(with_edits("abc", {{{0, 1}, "xyz"}, {{2, 3}, ""}, {{1, 1}, "-"}}) == "xyz-b");
  }
}
