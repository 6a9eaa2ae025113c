#include "interpret/language/condition_words.h"

#include "interpret/language/findings.h"

#include <doctest/doctest.h>

using namespace oriel::rules;

namespace {

enum class Speaks { of_feature, of_pair, of_macro };

std::string words_of(const std::string& condition, Speaks how = Speaks::of_feature) {
  const Source source("t.yaml", condition);
  Findings findings(source);
  const auto syntax = parse_expression({0, condition.size()}, findings);
  REQUIRE(syntax);
  const ConditionWords words(source, {{"least", "0.3 m"}});
  if (how == Speaks::of_pair) return words.pair_condition(*syntax);
  return how == Speaks::of_macro ? words.macro(*syntax) : words.condition(*syntax);
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("comparisons are said in words with the values of params") {
    CHECK(words_of("width >= $least") == "`width` is at least `$least` (0.3 m)");
    CHECK(words_of("width < $other") == "`width` is less than `$other`");
    CHECK(words_of("a in 1 m .. 2 m") == "`a` is between 1 m and 2 m");
    CHECK(words_of("sense in [hole, cavity, imprint]") == "`sense` is hole, cavity or imprint");
    CHECK(words_of("sense != hole") == "`sense` is not hole");
    CHECK(words_of("abs(a - b) <= 0.1 m") == "`a` and `b` differ by at most 0.1 m");
    CHECK(words_of("a > 0.5 mm@map") == "`a` is more than 0.5 mm on the map");
    CHECK(words_of("max(a, b) > min(a, b, c)") ==
          "the larger of `a` and `b` is more than the smallest of `a`, `b` and `c`");
  }

  TEST_CASE("arithmetic has the brackets that it needs") {
    CHECK(words_of("a * (b + c) > 1 m2") == "`a` × (`b` + `c`) is more than 1 m2");
    CHECK(words_of("0.5 * a * b > 1 m2") == "0.5 × `a` × `b` is more than 1 m2");
    CHECK(words_of("a - (b - c) > 1 m") == "`a` - (`b` - `c`) is more than 1 m");
    CHECK(words_of("a / (b * c) > 1 m") == "`a` / (`b` × `c`) is more than 1 m");
  }

  TEST_CASE("classes and hosts are said with their article") {
    CHECK(words_of("self is opening") == "it is an `opening`");
    CHECK(words_of("not self is door") == "it is not a `door`");
    CHECK(words_of("host is wall") == "it lies in a wall");
    CHECK(words_of("not host is ground") == "it does not lie in the ground");
    CHECK(words_of("host is panel") == "its host is a `panel`");
    CHECK(words_of("natural and not tall") == "`natural` holds, and `tall` does not hold");
  }

  TEST_CASE("parts that would be misread are in brackets") {
    CHECK(words_of("tall and (is door or is window)") ==
          "`tall` holds, and (it is a `door`, or it is a `window`)");
    CHECK(words_of("exists(beside where is door and a > 1 m) and tall") ==
          "(there is a feature beside it for which it is a `door`, and `a` is more than 1 m), and "
          "`tall` holds");
    CHECK(words_of("count(alike where is door and tall) >= 2") ==
          "the number of features like it for which (it is a `door`, and `tall` holds) is at least "
          "2");
  }

  TEST_CASE("relations are said of features and of their others") {
    CHECK(words_of("exists(same_storey)") == "there is an opening in its storey");
    CHECK(words_of("not exists(above)") == "there is no feature above it");
    CHECK(words_of("none(row where is door)") ==
          "there is no feature related by `row` for which it is a `door`");
    CHECK(words_of("all(beside where a > self.a)") ==
          "all features beside it are such that `a` is more than the feature's own `a`");
    CHECK(words_of("mean(width of alike) > 1 m") ==
          "the mean `width` of all features like it is more than 1 m");
    CHECK(words_of("a ~ other.a by 10 %", Speaks::of_pair) ==
          "`a` and the other's `a` differ by at most 10 %");
    CHECK(words_of("self.top > top", Speaks::of_macro) ==
          "the feature's own `top` is more than `top`");
  }
}
