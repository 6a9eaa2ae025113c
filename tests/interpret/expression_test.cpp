#include "tests/interpret/support.h"

#include <fmt/format.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// What is wrong with one condition, which stands on line 8 from column 9 on.
std::string fault(const std::string& condition) { return findings(pack_requiring({condition})); }

/// The message about one condition with its caret.
std::string message(const std::string& condition, int column, int length,
                    const std::string& sentence) {
  return fmt::format("t.yaml:8:{}: {}\n      - {}\n{:>{}}{}\n", column, sentence, condition, "^",
                     column, std::string(static_cast<std::size_t>(length) - 1, '~'));
}

void check_fault(const std::string& condition, int column, int length,
                 const std::string& sentence) {
  CHECK(fault(condition) == message(condition, column, length, sentence));
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("carets point into plain quoted and flow scalars") {
    check_fault("heigth > 1 m", 9, 6, "R204 unknown attribute 'heigth'; did you mean 'height'?");
    check_fault("'depth > 1 m and heigth > 1 m'", 26, 6,
                "R204 unknown attribute 'heigth'; did you mean 'height'?");
    check_fault("\"depth > 1 m and heigth > 1 m\"", 26, 6,
                "R204 unknown attribute 'heigth'; did you mean 'height'?");
    const std::string found = findings(pack_with(
        "rules:\n  - {id: w, label: window, require: [natural, \"a > 1 m\", c > 1 mm and widht > 1 "
        "m]}\n"));
    CHECK(found ==
          "t.yaml:5:71: R204 unknown attribute 'widht'; did you mean 'width'?\n"
          "  - {id: w, label: window, require: [natural, \"a > 1 m\", c > 1 mm and widht > 1 m]}\n"
          "                                                                      ^~~~~\n");
  }

  TEST_CASE("unknown names are named with what was probably meant") {
    check_fault("self is windw", 17, 5, "R205 unknown class 'windw'; did you mean 'window'?");
    check_fault("host is rof", 17, 3, "R205 unknown class 'rof'; did you mean 'roof'?");
    check_fault("self is wall", 17, 4, "R205 'wall' is a kind of host facet: write 'host is wall'");
    check_fault(
        "depth > $deep", 17, 5,
        "R206 unknown param 'deep'; the pack has none: write 'params: {deep: {value: ...}}'");
    check_fault("exists(contians)", 16, 8,
                "R207 unknown relation 'contians'; did you mean 'contains'?");
    CHECK(findings(pack_with("params: {sill_max: {value: 1 m}}\nmacros: {vertical: depth < "
                             "$sillmax}\nrules: [{id: w, label: window, require: vertcal}]\n")) ==
          "t.yaml:6:41: R208 unknown macro 'vertcal'; did you mean 'vertical'?\n"
          "rules: [{id: w, label: window, require: vertcal}]\n"
          "                                        ^~~~~~~\n");
  }

  TEST_CASE("an unknown param inside a macro is found where it stands") {
    CHECK(findings(pack_with("params: {sill_max: {value: 1 m}}\nmacros: {low: depth < $sillmax}\n"
                             "rules: [{id: w, label: window, require: low and low}]\n")) ==
          "t.yaml:5:23: R206 unknown param 'sillmax'; did you mean 'sill_max'?\n"
          "macros: {low: depth < $sillmax}\n"
          "                      ^~~~~~~~\n");
  }

  TEST_CASE("dimensions that differ are refused") {
    check_fault("height > 3 deg", 18, 5, "R230 'height' is a length and '3 deg' is an angle");
    check_fault("volume > a * b", 18, 5, "R230 'volume' is a volume and 'a * b' is an area");
    check_fault("a + silhouette > 1 m", 13, 10, "R230 'a' is a length and 'silhouette' is an area");
    check_fault("sqrt(a) > 1 m", 9, 7, "R230 the square root of a length has no unit");
    check_fault("a ~ b by 10 cm", 18, 5,
                "R230 after 'by' comes a share such as 10 %, not a length; for a fixed distance "
                "write abs(x - y) <= ...");
    CHECK(fault("a * b * c > 1 m3 and sqrt(silhouette) ~ a by 10 % and a / b > 1.2").empty());
  }

  TEST_CASE("a number without its unit is refused with the unit it needs") {
    check_fault("height > 1", 18, 1, "R231 'height' is a length: write 1 m");
    check_fault("volume > 1.5", 18, 3, "R231 'volume' is a volume: write 1.5 m3");
    check_fault("inclination in 80 .. 100 deg", 24, 2,
                "R231 'inclination' is an angle: write 80 deg");
    check_fault("abs(height - 2) < 1 m", 22, 1, "R231 'height' is a length: write 2 m");
    check_fault("height > -1", 18, 2, "R231 'height' is a length: write -1 m");
  }

  TEST_CASE("units are known and others are refused") {
    CHECK(fault("a < 1 m and a < 100 cm and a < 1000 mm and quality < 50 %").empty());
    check_fault("a < 1 metre", 15, 5, "R233 there is no unit 'metre'; oriel calls it 'm'");
    check_fault("a < 1 parsec", 15, 6,
                "R233 unknown unit 'parsec'; the units are: m, cm, mm, m2, m3, deg, %, mm@map");
    check_fault("a < 1 mx", 15, 2, "R233 unknown unit 'mx'; did you mean 'mm'?");
    check_fault("a < 1 mm@map", 13, 8,
                "R235 mm@map has a meaning only under 'generalise:', where there is a scale");
  }

  TEST_CASE("types are kept apart") {
    check_fault("depth", 9, 5, "R232 'depth' is a length; a condition is needed here");
    check_fault("depth > natural", 17, 7, "R232 'natural' is yes or no; a number is needed here");
    check_fault("sense > hole", 15, 1,
                "R232 'sense' is a text; texts are compared with =, != and in [..]");
    check_fault("sense", 9, 5, "R232 'sense' is a text; a condition is needed here");
    check_fault("natural = 1", 9, 7,
                "R232 'natural' is yes or no already; write it alone, or 'not' in front");
    check_fault("not depth", 13, 5, "R232 'depth' is a length; a condition is needed here");
  }

  TEST_CASE("words that a text never is are refused") {
    check_fault("sense = whole", 17, 5, "R234 'sense' is never 'whole'; did you mean 'hole'?");
    check_fault("ground_source = air", 25, 3,
                "R234 'ground_source' is never 'air' (it is one of facet, wall, body)");
  }

  TEST_CASE("self and other are refused where they mean nothing") {
    check_fault("other.a > 1 m", 9, 7, "R236 'other' has a meaning only after 'where'");
    check_fault("exists(contains where exists(contains where self.a > a))", 53, 6,
                "R236 'self' does not reach into a quantifier inside a quantifier");
    CHECK(fault("exists(contains where self.a > other.a and a > 1 m)").empty());
  }

  TEST_CASE("syntax errors say what was expected and what was found") {
    check_fault("depth <=", 17, 1, "R220 expected a value or a condition, found the end");
    check_fault("(depth <= 1 m", 22, 1, "R220 expected ')', found the end");
    check_fault("depth 1 m", 15, 1, "R220 expected an operator or the end, found '1'");
    check_fault("a in 1 m 2 m", 18, 1, "R220 expected '..' as in 0.3 m .. 2.2 m, found '2'");
    check_fault("a ~ b", 14, 1, "R220 expected 'by' as in a ~ other.a by 10 %, found the end");
    check_fault("0 m < a < 1 m", 17, 1,
                "R220 comparisons are not chained; write 'x in lo .. hi' or use 'and'");
    check_fault("a < 1,5 m", 14, 1,
                "R220 expected an operator or the end, found ','; decimals are written with a "
                "point: 1.5");
    check_fault("host.a > 1 m", 13, 1,
                "R220 expected 'is' and a class, as in 'host is wall', found '.'");
    check_fault("self is not window", 17, 3,
                "R220 'is not': write 'not' in front, as in 'not self is window'");
    check_fault("window is opening", 9, 6,
                "R220 'is' asks for a class: write 'self is', 'host is' or 'is' alone before it");
    check_fault("maxi(a, b) > 1 m", 9, 4, "R220 unknown function 'maxi'; did you mean 'max'?");
    check_fault("abs(a, b) > 1 m", 9, 3, "R220 'abs' takes one value");
    check_fault("max(a) > 1 m", 9, 3, "R220 'max' takes two values or more");
    check_fault("exists contains", 16, 8, "R220 expected '(' after 'exists', found 'contains'");
  }

  TEST_CASE("symbols of other languages get advice") {
    check_fault("sense == hole", 15, 2, "R220 '==': write '='");
    check_fault("natural && natural", 17, 2, "R220 '&&': write 'and'");
    check_fault("natural & natural", 17, 1, "R220 '&': write 'and'");
    check_fault("natural | natural", 17, 1, "R220 '|': write 'or'");
    check_fault("sense:hole", 14, 1, "R220 ':': write '='");
    check_fault("new_area > 1 m²", 23, 1, "R220 '²': write 'm2' for m²");
    check_fault("natural || natural", 17, 2, "R220 '||': write 'or'");
    check_fault("a \xE2\x89\xA4 1 m", 11, 1, "R220 '\xE2\x89\xA4': write '<='");
    check_fault("a ; b", 11, 1, "R220 ';' has no meaning in an expression");
    check_fault("a > 1e999 m", 13, 5, "R220 this number is too large or too small");
    check_fault("a > $ m", 13, 1, "R220 after '$' comes the name of a param");
  }

  TEST_CASE("expressions that no caret could point into are refused") {
    const std::string sentence =
        "R221 an expression is written on one line without escapes, so that messages can point "
        "into it";
    check_fault("\"depth \\u003c 1 m\"", 10, 1, sentence);
    check_fault("'sense = ''hole'''", 10, 1, sentence);
    CHECK(findings(pack_requiring({"depth >\n          1 m"}))
              .starts_with(
                  "t.yaml:8:9: R221 this continues on the next line: an expression is written on "
                  "one line, and several conditions are a list, each on a line after '- '\n"));
    CHECK(findings(pack_requiring({"|\n          depth > 1 m"}))
              .starts_with("t.yaml:8:9: " + sentence + "\n"));
  }

  TEST_CASE("expressions beyond the limits are refused") {
    std::string sum = "a";
    for (int i = 0; i < 70; ++i) sum += " + a";
    CHECK(fault(sum + " > 1 m").find("R222 an expression nests no deeper than 64 levels") !=
          std::string::npos);
    CHECK(fault(std::string(80, '(') + "natural" + std::string(80, ')'))
              .find("R222 an expression nests no deeper than 64 levels") != std::string::npos);
    CHECK(fault("\"" + std::string(1001, ' ') + "natural\"")
              .find("R222 an expression is no longer than 1000 characters; use macros") !=
          std::string::npos);
    CHECK(fault("exists(contains where exists(contains where exists(contains)))")
              .find("R222 quantifiers nest no deeper than two levels") != std::string::npos);
    std::string conjunction = "natural";
    for (int i = 0; i < 80; ++i) conjunction += " and natural";
    CHECK(fault(conjunction).find("R222") == std::string::npos);
  }

  TEST_CASE("macros that would explode are refused") {
    std::string macros = "macros:\n  m0: natural\n";
    for (int i = 1; i < 40; ++i) macros += fmt::format("  m{}: m{} or not m{}\n", i, i - 1, i - 1);
    CHECK(findings(pack_with(macros + "rules: [{id: w, label: window, require: m39}]\n"))
              .find("R222 with its macros this expression") != std::string::npos);
  }

  TEST_CASE("macros that need themselves are refused") {
    CHECK(findings(pack_with("macros: {m: n and natural, n: m}\n"
                             "rules: [{id: w, label: window, require: m}]\n")) ==
          "t.yaml:4:31: R247 the macro 'm' uses itself\n"
          "macros: {m: n and natural, n: m}\n"
          "                              ^\n");
  }

  TEST_CASE("an empty range is refused") {
    check_fault("a in 2 m .. 1 m", 14, 10,
                "R212 an empty range: its low end is above its high end");
  }
}
