#include "kernel/base/text/xml.h"

#include <doctest/doctest.h>

TEST_SUITE("kernel/base") {
  TEST_CASE("a text is escaped as XML can hold it") {
    using namespace std::string_literals;
    using oriel::escaped_xml;
    CHECK(escaped_xml("Haus 1") == "Haus 1");
    CHECK(escaped_xml("<a b=\"c\">&") == "&lt;a b=&quot;c&quot;&gt;&amp;");
    CHECK(escaped_xml("a\tb\nc\rd") == "a&#9;b&#10;c&#13;d");
    CHECK(escaped_xml("Straße 水 \xF0\x9F\x8F\xA0") == "Straße 水 \xF0\x9F\x8F\xA0");
    // Control characters, a byte alone, an overlong form, a surrogate, a cut end and U+FFFE.
    for (const auto& bad : {"\0"s, "\x1b"s, "\xFF"s, "\xE2"s, "\xEF\xBF\xBE"s})
      CHECK(escaped_xml("a" + bad + "b") == "a\uFFFDb");
    CHECK(escaped_xml("\xC0\xAF") == "\uFFFD\uFFFD");
    CHECK(escaped_xml("\xED\xA0\x80") == "\uFFFD\uFFFD\uFFFD");
    CHECK(escaped_xml("a\xE6\xB0") == "a\uFFFD\uFFFD");
    CHECK(escaped_xml("\x7F") == "\x7F");
  }
}
