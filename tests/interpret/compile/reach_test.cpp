#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// The findings of a pack with those rules on lines 5 and following.
std::string of_rules(const std::vector<std::string>& rules) {
  std::string body = "rules:\n";
  for (const std::string& rule : rules) body += "  - {" + rule + "}\n";
  return findings(pack_with(body));
}

std::string of_condition(const std::string& require, const std::string& more = "") {
  return of_rules({"id: w, label: window, require: \"" + require + "\"" + more});
}

bool says(const std::string& findings, const std::string& code) {
  return findings.find(": " + code + " ") != std::string::npos;
}

std::string of_entries(const std::string& entries) {
  return findings(pack_with("rules: [{id: w, label: window, require: natural}]\ngeneralise: [" +
                            entries + "]\n"));
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("conditions that exclude each other are found") {
    for (const std::string condition :
         {"a > 2 m and a < 1 m", "a > 1 m and a < 1 m", "a >= 1 m and a < 1 m",
          "a in 1 m .. 2 m and a > 2 m", "2 m < a and not a > 1 m", "natural and not natural",
          "sense = hole and sense = imprint", "sense in [hole, cavity] and sense = imprint",
          "host is wall and host is roof", "exists(beside) and not exists(beside)",
          "a = 1 m and a = 2 m", "not (a > 1 m or natural) and natural"})
      CHECK_MESSAGE(says(of_condition(condition), "R254"), condition);
  }

  TEST_CASE("conditions that can hold together are left alone") {
    for (const std::string condition :
         {"a > 1 m and a < 2 m", "a >= 1 m and a <= 1 m", "a > 2 m and b < 1 m",
          "a > 2 m or a < 1 m", "exists(beside where a < 1 m) and a > 2 m",
          "sense in [hole, cavity] and sense in [cavity, imprint]", "a != 1 m and a = 2 m",
          "exists(beside where natural) and not natural", "sense != hole and sense = imprint"})
      CHECK_MESSAGE(of_condition(condition).empty(), condition);
  }

  TEST_CASE("the values of params and the rules of predicates count") {
    const std::string params = "params: {low: {value: 1 m}, high: {value: 2 m}}\n";
    CHECK(says(findings(pack_with(params + "rules: [{id: w, label: window, require: a < $low and a "
                                           "> $high}]\n")),
               "R254"));
    const std::vector<std::string> opening = {
        "id: o1, label: opening, require: a in 1 m .. 2 m and sense = hole",
        "id: o2, label: opening, require: a in 3 m .. 4 m and sense = imprint"};
    auto rules = opening;
    rules.push_back("id: w, label: window, require: self is opening and a > 4 m");
    CHECK(of_rules(rules) ==
          "t.yaml:7:57: R254 the rule 'w' can never hold: 'self is opening' and 'a > 4 m' exclude "
          "each other\n"
          "  - {id: w, label: window, require: self is opening and a > 4 m}\n"
          "                                                        ^~~~~~~\n");
    rules.back() = "id: w, label: window, require: self is opening and a > 2.5 m";
    CHECK(of_rules(rules).empty());
    rules.back() = "id: w, label: window, require: self is opening and sense = cavity";
    CHECK(says(of_rules(rules), "R254"));
  }

  TEST_CASE("a veto that follows from what is required is found") {
    CHECK(says(of_condition("a > 2 m", ", unless: a > 1 m"), "R254"));
    CHECK(says(of_condition("natural", ", unless: natural or a > 1 m"), "R254"));
    CHECK(of_condition("a > 1 m", ", unless: a > 2 m").empty());
    CHECK(of_condition("natural", ", unless: natural and a > 1 m").empty());
  }

  TEST_CASE("a rule that can never hold is not said to come behind another one") {
    const std::string text = of_rules({"id: a, label: door, require: a > 1 m, priority: 1",
                                       "id: b, label: window, require: a > 3 m, unless: a > 2 m"});
    CHECK(says(text, "R254"));
    CHECK_FALSE(says(text, "R255"));
  }

  TEST_CASE("a rule before which another one always comes is found") {
    const std::string first = "id: a, label: door, require: a > 1 m, priority: 1";
    CHECK(says(of_rules({first, "id: b, label: window, require: a > 2 m"}), "R255"));
    CHECK(says(of_rules({first, "id: b, label: window, require: a in 2 m .. 3 m and natural"}),
               "R255"));
    CHECK(of_rules({first, "id: b, label: window, require: a > 0.5 m"}).empty());
    CHECK(of_rules({first, "id: b, label: window, require: a > 2 m, priority: 2"}).empty());
    CHECK(
        of_rules({first + ", unless: natural", "id: b, label: window, require: a > 2 m"}).empty());
    CHECK(
        of_rules({first + ", score: [natural]", "id: b, label: window, require: a > 2 m"}).empty());
    CHECK(says(of_rules({"id: o1, label: opening, require: a > 1 m",
                         "id: o2, label: opening, require: a > 2 m"}),
               "R255 the rule 'o2' adds nothing") == false);
    CHECK(of_rules({"id: o1, label: opening, require: a > 1 m",
                    "id: o2, label: opening, require: a > 2 m"})
              .find("R255 the rule 'o2' adds nothing") != std::string::npos);
  }

  TEST_CASE("vetoes are the same only if what they ask of others is") {
    const auto of_vetoes = [](const std::string& first, const std::string& second) {
      return of_rules(
          {"id: a, label: door, priority: 1, require: a > 1 m, unless: \"" + first + "\"",
           "id: b, label: window, require: a > 2 m, unless: \"" + second + "\""});
    };
    const std::string veto = "max(a of beside) > 3 m";
    CHECK(says(of_vetoes(veto, veto), "R255"));
    CHECK(of_vetoes(veto, "max(b of beside) > 3 m").empty());
    CHECK(of_vetoes(veto, "min(a of beside) > 3 m").empty());
    CHECK(of_vetoes(veto, "max(a of beside where natural) > 3 m").empty());
    CHECK(of_vetoes(veto, "max(a of same_facade) > 3 m") == "");
  }

  TEST_CASE("a rule that refines what another one decides is left alone") {
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
                   "classes: {window: {}, french: {is: window}}\nrules:\n"
                   "  - {id: a, label: window, require: a > 1 m, priority: 1}\n"
                   "  - {id: b, label: french, require: self is window and a > 2 m}\n")
              .empty());
  }

  TEST_CASE("an entry for a group behind one for the same group is found") {
    const auto of_groups = [](const std::string& second) {
      return findings(pack_with(
          "rules: [{id: w, label: window, require: natural}]\n"
          "groups: {row: {of: window, by: same_storey}, column: {of: window, by: same_facade}}\n"
          "generalise: [{id: a, scale: \"1:1000 ..\", for: group row, do: omit}, {id: b, scale: "
          "\"1:2000 ..\", for: group " +
          second + ", do: omit}]\n"));
    };
    CHECK(says(of_groups("row"), "R255"));
    CHECK(of_groups("column") == "");
  }

  TEST_CASE("entries that never decide are found") {
    const std::string all = "{id: a, scale: \"1:1000 ..\", for: any, do: omit}, ";
    CHECK(says(of_entries(all + "{id: b, scale: \"1:2000 ..\", for: window, do: omit}"), "R255"));
    CHECK(of_entries(all + "{id: b, scale: \"1:500 ..\", for: window, do: omit}").empty());
    CHECK(of_entries("{id: a, scale: \"1:1000 ..\", for: window, do: omit}, "
                     "{id: b, scale: \"1:2000 ..\", for: any, do: omit}")
              .empty());
    CHECK(of_entries("{id: a, scale: \"1:1000 ..\", for: any, when: natural, do: omit}, "
                     "{id: b, scale: \"1:2000 ..\", for: window, do: omit}")
              .empty());
  }

  TEST_CASE("an entry that is refused is not said never to decide as well") {
    const std::string all = "{id: a, scale: \"1:1000 ..\", for: any, do: omit}, ";
    const std::string text = of_entries(all + "{for: window, scales: \"1:2000 ..\", do: merge}");
    CHECK(says(text, "R210"));
    CHECK_FALSE(says(text, "R255"));
    CHECK_FALSE(says(text, "R256"));
  }
}
