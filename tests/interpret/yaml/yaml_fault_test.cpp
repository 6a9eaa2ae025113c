#include "interpret/yaml/yaml_fault.h"

#include <string>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::rules;

namespace {

/// What is said of the first fault in a text that a parser could not read to its end.
std::string fault_in(const std::string& text) {
  const auto fault = find_yaml_fault(text, text.size());
  return fault ? fault->sentence : "";
}

/// The text that the fault is at.
std::string place_in(const std::string& text) {
  const auto fault = find_yaml_fault(text, text.size());
  REQUIRE(fault);
  return text.substr(fault->where.begin, fault->where.end - fault->where.begin);
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("what is right in YAML has no fault") {
    const std::string text =
        "schema: oriel/1\r\n"
        "# a comment: with a colon\n"
        "params:\n"
        "  sill: {value: 0.8 m,   # a [ in a comment\n"
        "    range: 0.3 m .. 1.2 m, why: \"a text, with: signs\"}\n"
        "  text:\n"
        "    why: |\n"
        "      any: thing: here\n"
        "    \t  [ even this\n"
        "  long: 'over\n"
        "    two lines'\n"
        "  next: a text\n"
        "    that goes on\n"
        "  url: http://example.org/a#b\n"
        "rules:\n"
        "- id: w\n"
        "  \"label\": window\n"
        "  require:\n"
        "  - a in [1, 2] and b > -1 m\n"
        "  - {x: [1, {y: 2}], \"z\":3}\n"
        "- - 1\n"
        "  - 2\n"
        "last: [\n"
        "]\n";
    CHECK(fault_in(text) == "");
  }

  TEST_CASE("a tab is put in place of by the spaces that the lines above ask for") {
    CHECK(fault_in("a:\n\tb: 1\n") ==
          "there is a tab before this line; YAML is indented by spaces; write '  b: 1'");
    CHECK(fault_in("a:\n    b: 1\n\tc: 1\n") ==
          "there is a tab before this line; YAML is indented by spaces; write '    c: 1'");
    CHECK(place_in("a:\n \tb: 1\n") == "\t");
  }

  TEST_CASE("the column of a key is that of the nearest map above it") {
    CHECK(fault_in("a:\n  b: 1\n c: 2\n") ==
          "'c' is indented by 1 space, 'b' above it by 2; write '  c: 2'");
    CHECK(fault_in("a: 1\n  b: 2\n") ==
          "'b' is indented by 2 spaces, 'a' above it by 0; write 'b: 2'");
    CHECK(fault_in("a:\n  - b: 1\n  c: 2\n") ==
          "'c' is indented by 2 spaces, 'b' above it by 4; write '    c: 2'");
    CHECK(fault_in("- a\nb: 1\n") ==
          "'b' begins a map, but the lines above are items of a list; begin it with '- '");
    CHECK(
        fault_in("a: 1\n- b\n") ==
        "a list begins here, but 'a' has a value on its own line already; put that value below it "
        "as the first item, '- ...'");
  }

  TEST_CASE("quotes that do not end with their line are closed there") {
    CHECK(fault_in("a: 'text # more\nb: 1\n") ==
          "the quote that opens here is not closed on its line; write 'a: 'text # more''");
    CHECK(fault_in("a: {b: \"text, c: 1}\n") ==
          "the quote that opens here is not closed on its line; write 'a: {b: \"text\", c: 1}'");
    CHECK(fault_in("a: \"one\nb: \"two\"\n") ==
          "the quote that opens here is not closed on its line; write 'a: \"one\"'");
    CHECK(place_in("a: \"one\nb: \"two\"\n") == "\"");
  }

  TEST_CASE("brackets are closed where the line ends that they are on") {
    CHECK(fault_in("a: [1, {b: 2\nc: 3\n") ==
          "the '{' that opens here is never closed; write 'a: [1, {b: 2}]'");
    CHECK(fault_in("a: [1, 2  # three\n") ==
          "the '[' that opens here is never closed; write 'a: [1, 2]  # three'");
    CHECK(fault_in("a: [1]]\n") == "nothing is open that ']' could close; write 'a: [1]'");
    CHECK(fault_in("a: [1] 2\n") == "a list or map in brackets ends here, but the line goes on");
    CHECK(fault_in("a: [\"b\" \"c\"]\n") ==
          "a comma is missing before this; write 'a: [\"b\", \"c\"]'");
    CHECK(fault_in("a: [{b: 1}\n  {c: 2}]\n") ==
          "a comma is missing at the end of the line above this one");
  }

  TEST_CASE("texts that YAML reads otherwise are put in quotes") {
    CHECK(fault_in("a: b: c\n") ==
          "a second colon on one line; a text with a colon needs quotes; write 'a: \"b: c\"'");
    CHECK(
        fault_in("a: say \"b: c\"\n") ==
        "a second colon on one line; a text with a colon needs quotes; write 'a: 'say \"b: c\"''");
    CHECK(fault_in("- id: w label: window\n") ==
          "a second key, 'label', on one line; it goes on a line of its own");
    CHECK(fault_in("a: @b\n") ==
          "a text cannot begin with '@' unless it is in quotes; write 'a: \"@b\"'");
    CHECK(fault_in("a: %50\n") ==
          "a text cannot begin with '%' unless it is in quotes; the unit % comes after its number; "
          "write 'a: 50 %'");
  }

  TEST_CASE("a line that is too long to be read is not shown mended") {
    const std::string text(300, 'x');
    CHECK(fault_in("a: \"" + text + "\n") == "the quote that opens here is not closed on its line");
  }

  TEST_CASE("lines after the one where the parser stopped are not looked at") {
    const std::string text = "a: 1\n\tb: 2\n";
    CHECK_FALSE(find_yaml_fault(text, 2));
    CHECK(find_yaml_fault(text, 5));
    CHECK_FALSE(find_yaml_fault("", 0));
  }

  TEST_CASE("any piece of a text is looked at without harm") {
    const std::string text = "a: [\"b\", {c: 'd'}]\n- e: | x\n\tf:\n  - \"g\n}: ]\n%: @\n--- -h\n";
    for (std::size_t begin = 0; begin <= text.size(); ++begin)
      for (std::size_t end = begin; end <= text.size(); ++end) {
        const std::string piece = text.substr(begin, end - begin);
        const auto fault = find_yaml_fault(piece, piece.size());
        if (!fault) continue;
        CHECK(fault->where.begin <= fault->where.end);
        CHECK(fault->where.end <= piece.size());
      }
  }
}
