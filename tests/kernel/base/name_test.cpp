#include "kernel/base/name.h"

#include <map>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel {
namespace {

TEST_SUITE("model") {
  TEST_CASE("names of equal texts are the same text in memory") {
    const std::string text = "a label that is longer than what a string holds itself";
    const Name name(text), again(std::string_view{text});
    CHECK(&name.text() == &again.text());
    CHECK(&name.text() != &text);
    CHECK(name == again);
    CHECK(name == text);
    CHECK(name != Name("door"));
  }

  TEST_CASE("the empty name is equal to the empty text") {
    CHECK(Name() == Name(""));
    CHECK(Name().empty());
    CHECK(Name() == "");
    CHECK(Name().text().empty());
    CHECK_FALSE(Name("door").empty());
  }

  TEST_CASE("names sort and print as their texts do") {
    CHECK(Name("door") < Name("window"));
    CHECK(Name() < Name("door"));
    CHECK(fmt::format("{:>6}", Name("door")) == "  door");
    std::map<std::string, int> counts;
    ++counts[Name("door")];
    CHECK(counts.at("door") == 1);
  }
}

}  // namespace
}  // namespace oriel
