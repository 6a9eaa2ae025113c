#include "studio/server/token.h"

#include <set>
#include <string>

#include <doctest/doctest.h>

using namespace oriel::studio;

TEST_SUITE("studio/server") {
  TEST_CASE("a token is 32 hexadecimal digits and no two are the same") {
    std::set<std::string> tokens;
    for (int i = 0; i < 100; ++i) {
      const std::string token = random_token();
      CHECK(token.size() == 32);
      CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
      tokens.insert(token);
    }
    CHECK(tokens.size() == 100);
  }

  TEST_CASE("only the whole token is the token") {
    CHECK(is_same_token("abc", "abc"));
    for (const char* given : {"", "ab", "abd", "abca", "abcabc", "bc"})
      CHECK_FALSE(is_same_token("abc", given));
    CHECK_FALSE(is_same_token("", ""));
  }
}
