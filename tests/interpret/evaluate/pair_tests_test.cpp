#include "tests/interpret/support.h"

#include <array>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using namespace oriel::test;

/// window where the quantifier holds, door where it does not, neither where it is unknown.
RuleBase pack_asking(const std::string& quantifier) {
  return load(
      pack_with(fmt::format("rules:\n"
                            "  - {{id: w, label: window, require: '{0}'}}\n"
                            "  - {{id: d, label: door, require: 'not {0}'}}\n",
                            quantifier)));
}

/// Features of which some related ones have no value.
Scene random_scene() {
  Scene scene;
  const int count = *rc::gen::inRange(1, 12);
  const bool has_gaps = *rc::gen::inRange(0, 2) == 1;
  for (int i = 0; i < count; ++i) {
    Values values;
    for (const char* name : {"base_height", "a", "b"}) {
      const int n = *rc::gen::inRange(-3, 4);
      if (!has_gaps || n != 0) values[name] = n * 0.5;
    }
    scene.add(values);
    for (int j = 0; j < i; ++j)
      if (*rc::gen::inRange(0, 4) > 0) scene.relate_both("beside", FeatureId{i}, FeatureId{j});
  }
  return scene;
}

TEST_SUITE("interpret") {
  // The least of a number and itself is that number, but no test of pairs is made of it.
  TEST_CASE("tests of pairs answer as the conditions that they are made of") {
    const std::array<std::string, 6> values = {
        "base_height",
        "(base_height - self.base_height)",
        "(self.base_height - base_height)",
        "abs(base_height - self.base_height)",
        "abs(self.a - base_height)",
        "(base_height - 2 * self.a)",
    };
    const std::array<std::string, 10> conditions = {
        "{0} <= 0.5 m",      "{0} < self.b",
        "{0} >= self.b",     "{0} > self.b",
        "{0} = self.b",      "not {0} <= self.b",
        "not {0} > 0.5 m",   "{0} in self.b .. 1 m",
        "{0} in 0 m .. 1 m", "self.b >= {0} and {0} > -1 m",
    };
    const std::array<std::string, 5> quantifiers = {
        "exists(beside where {})", "none(beside where {})", "all(beside where {})",
        "count(beside where {}) >= 2", "count(beside where {} and a > 0 m) < 3"};
    std::array<std::size_t, 3> answers{};
    CHECK(rc::check("tests of pairs", [&] {
      const auto one_of = [](const auto& list) {
        return list[*rc::gen::inRange(std::size_t{0}, list.size())];
      };
      const std::string value = one_of(values);
      const std::string condition = one_of(conditions);
      const std::string quantifier = one_of(quantifiers);
      const auto asking = [&](const std::string& number) {
        return pack_asking(
            fmt::format(fmt::runtime(quantifier), fmt::format(fmt::runtime(condition), number)));
      };
      const Scene scene = random_scene();
      const Labels found = labels(asking(value), scene);
      RC_ASSERT(found == labels(asking(fmt::format("min({0}, {0})", value)), scene));
      for (const std::string& label : found)
        ++answers[label == "window" ? 0U : label == "door" ? 1U : 2U];
    }));
    // It was about something.
    for (const std::size_t count : answers) CHECK(count > 20);
  }
}

}  // namespace
}  // namespace oriel
