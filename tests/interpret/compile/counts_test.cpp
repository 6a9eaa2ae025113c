#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// Findings of a pack with those lines for its classes and `decide`, which stand on lines 3 and 4.
std::string findings_of(const std::string& classes, const std::string& decide) {
  return findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {" + classes +
                  "}\ndecide: {" + decide +
                  "}\nrules: [{id: w, label: window, require: natural}]\n");
}

std::string counting(const std::string& typical) {
  return findings_of("window: {typical: {" + typical + "}}", "ambiguous_below: 0.2, evidence: 0.1");
}

constexpr const char* kCountedWeighing = "ambiguous_below: 0.2, evidence: 0.1";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("counts are whole numbers from nothing to many") {
    CHECK(counting("per storey: 0 .. 12, per facade: 1 .. 1, per building: 2 .. 40").empty());
    for (const char* wrong : {"-1 .. 2", "0.5 .. 2", "0 .. 2.5", "0 .. 1e7"}) {
      CAPTURE(wrong);
      CHECK(has(counting(std::string("per storey: ") + wrong),
                "t.yaml:3:42: R212 a count is a whole number, 0 or more, at most 1000000"));
    }
    CHECK(has(counting("per storey: 3 .. 2"), "t.yaml:3:42: R212 an empty range"));
    CHECK(has(counting("per storey: 1 m .. 2 m"), "R230"));
    CHECK(has(counting("per roof: 1 .. 2"), "t.yaml:3:30: R209"));
  }

  TEST_CASE("counts without an end have no most") {
    CHECK(counting("per storey: 1 .., per building: \"2 ..\"").empty());
    CHECK(has(counting("per storey: 0.5 .."), "R212 a count"));
    CHECK(has(counting("per storey: .."), "R220"));
    CHECK(has(counting("per storey: 3 .., per building: 1 .. 2"),
              "R212 3 .. 'window' per storey and 1 .. 2 'window' per building"));
    CHECK(has(counting("per storey: 1 m .."), "R23"));
  }

  TEST_CASE("no storey and no facade has more than its building") {
    CHECK(counting("per storey: 3 .. 9, per building: 1 .. 3").empty());
    CHECK(has(counting("per storey: 4 .. 9, per building: 1 .. 3"),
              "t.yaml:3:30: R212 4 .. 9 'window' per storey and 1 .. 3 'window' per building "
              "(t.yaml:3:50) exclude each other"));
    CHECK(has(counting("per facade: 4 .. 9, per building: 1 .. 3"), "R212"));
    CHECK(counting("per facade: 4 .. 9, per storey: 1 .. 3").empty());
  }

  TEST_CASE("there is no more of a class than of the class above it") {
    const std::string decide = "ambiguous_below: 0.2, evidence: 0.1";
    CHECK(has(findings_of("opening: {abstract: true, typical: {per storey: 0 .. 3}}, "
                          "window: {is: opening, typical: {per storey: 4 .. 9}}",
                          decide),
              "R212 4 .. 9 'window' per storey and 0 .. 3 'opening' per storey (t.yaml:3:47)"));
  }

  TEST_CASE("a count of too many is not taken for one without end") {
    CHECK(has(counting("per storey: 0 .. 2147483647"), "t.yaml:3:42: R212 a count is a whole"));
    CHECK(has(counting("per storey: 2147483647 .."), "t.yaml:3:42: R212 a count is a whole"));
  }

  TEST_CASE("a subclass that asks for more than the class above allows is refused") {
    CHECK(has(findings_of("window: {typical: {per building: 0 .. 3}}, "
                          "dormer_window: {is: window, typical: {per building: 4 ..}}",
                          kCountedWeighing),
              "t.yaml:3:92: R212 4 .. 'dormer_window' per building and 0 .. 3 'window' per "
              "building (t.yaml:3:30) exclude each other"));
    CHECK(has(findings_of("part: {abstract: true, typical: {per building: 0 .. 2}}, opening: "
                          "{is: part, abstract: true}, window: {is: opening, typical: {per "
                          "facade: 3 ..}}",
                          kCountedWeighing),
              "R212 3 .. 'window' per facade and 0 .. 2 'part' per building"));
  }

  TEST_CASE("classes that together ask for more than the class above allows are refused") {
    const auto parts = [](const std::string& opening, const std::string& window,
                          const std::string& door) {
      return findings_of("opening: {abstract: true, typical: {" + opening +
                             "}}, window: {is: opening, typical: {" + window +
                             "}}, door: {is: opening, typical: {" + door + "}}",
                         kCountedWeighing);
    };
    CHECK(has(parts("per storey: 0 .. 5", "per storey: 3 ..", "per storey: 3 .. 4"),
              "t.yaml:3:47: R212 0 .. 5 'opening' per storey cannot be: the classes beneath it are "
              "at least 6 together, 3 .. 'window' per storey (t.yaml:3:101), 3 .. 4 'door' per "
              "storey (t.yaml:3:151)\n"));
    CHECK(has(parts("per building: 0 .. 5", "per storey: 3 ..", "per facade: 3 ..  "), "R212"));
    std::string many = "window: {}, part: {abstract: true, typical: {per storey: 0 .. 6}}";
    for (int i = 0; i < 7; ++i)
      many += fmt::format(", c{}: {{is: part, typical: {{per storey: 1 ..}}}}", i);
    CHECK(
        has(findings_of(many, kCountedWeighing), "are at least 7 together, 1 .. 'c0' per storey"));
    CHECK(has(findings_of(many, kCountedWeighing), " and 2 more\n"));
    // A storey has fewer than its building: nothing is said of one.
    CHECK_FALSE(
        has(parts("per storey: 0 .. 5", "per building: 3 ..", "per building: 3 .."), "R212"));
    CHECK_FALSE(has(parts("per storey: 0 .. 6", "per storey: 3 ..", "per storey: 3 .."), "R212"));
  }

  TEST_CASE("a class whose subclasses may not come to what it asks for is refused") {
    const auto parts = [](const std::string& flags, const std::string& door) {
      return findings_of("opening: {" + flags +
                             "typical: {per storey: 5 .. 9}}, window: {is: opening, typical: {per "
                             "storey: 0 .. 2}}, door: {is: opening" +
                             door + "}",
                         kCountedWeighing);
    };
    CHECK(has(parts("abstract: true, ", ", typical: {per building: 0 .. 1}"),
              "R212 5 .. 9 'opening' per storey cannot be: the classes beneath it are at most 3 "
              "together, 0 .. 2 'window' per storey (t.yaml:3:101), 0 .. 1 'door' per building "));
    // Any number of doors, and features that are an opening and nothing more, may make it up.
    CHECK_FALSE(has(parts("abstract: true, ", ""), "R212"));
    CHECK_FALSE(has(parts("", ", typical: {per storey: 0 .. 1}"), "R212"));
  }

  TEST_CASE("none in a storey and some in the building go together") {
    // Skylights are in no storey.
    CHECK(counting("per storey: 0 .. 0, per building: 1 ..").empty());
    CHECK(has(counting("per storey: 1 .. 0"), "t.yaml:3:42: R212 an empty range"));
  }

  TEST_CASE("counts that nothing asks for are warned of") {
    CHECK(has(findings_of("window: {typical: {per storey: 1 .. 2}}", "min_score: 0.1"),
              "t.yaml:3:30: R257 'typical' of 'window' says nothing: 'evidence' under 'decide' "
              "says how much it may add"));
    const std::string decide = "ambiguous_below: 0.2, evidence: 0.1";
    CHECK(has(findings_of("window: {}, door: {typical: {per storey: 1 .. 2}}", decide),
              "t.yaml:3:40: R257 'typical' of 'door' says nothing: no rule has this label\n"));
    CHECK(has(findings_of("window: {}, part: {abstract: true, typical: {per storey: 1 .. 2}}, "
                          "door: {is: part}",
                          decide),
              "R257 'typical' of 'part' says nothing: no rule has this label or one beneath it"));
    CHECK(findings_of("window: {is: part}, part: {abstract: true, typical: {per storey: 1 .. 2}}",
                      decide)
              .empty());
  }

  TEST_CASE("evidence decides what is close and no more") {
    const auto deciding = [](const std::string& decide) {
      return findings_of("window: {}", decide);
    };
    CHECK(deciding("ambiguous_below: 0.1, evidence: 0.05").empty());
    CHECK(deciding("ambiguous_below: 10 %, evidence: 5 %").empty());
    const std::string half =
        "R212 'evidence' is at most half of 'ambiguous_below': it decides what is close only";
    CHECK(has(deciding("ambiguous_below: 0.1, evidence: 0.06"), "t.yaml:4:42: " + half));
    CHECK(has(deciding("evidence: 0.05"), half));
    CHECK(has(deciding("ambiguous_below: 0.1, evidence: -0.05"), "R212"));
    CHECK(has(deciding("ambiguous_below: 0.1, evidence: 1 m"), "R230"));
  }

  TEST_CASE("company is made of relations") {
    const auto with = [](const std::string& company) {
      return findings_of("window: {}", "ambiguous_below: 0.1, evidence: 0.05, company: " + company);
    };
    CHECK(with("[alike, same storey]").empty());
    CHECK(with("above").empty());
    CHECK(
        has(with("[alyke]"), "t.yaml:4:58: R207 unknown relation 'alyke'; did you mean 'alike'?"));
    CHECK(has(findings_of("window: {}", "company: alike"),
              "t.yaml:4:19: R257 'company' says nothing: 'evidence' says how much it may add"));
  }

  TEST_CASE("relations that evidence leads over are used") {
    const std::string sections =
        "relations:\n"
        "  alike: {within: alike, where: a ~ other.a by 5 %}\n"
        "  same_storey: {within: same storey, where: b = other.b}\n"
        "rules: [{id: w, label: window, require: natural}]\n";
    CHECK(has(findings(pack_with(sections)), "R248"));
    const auto checked = findings(
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {typical: "
        "{per storey: 1 .. 4}}}\n" +
        sections + "decide: {ambiguous_below: 0.1, evidence: 0.05}\n");
    CHECK(checked.empty());
  }

  TEST_CASE("what evidence may turn is not called shadowed") {
    const std::string rules =
        "rules:\n"
        "  - {id: a, label: door, require: a > 1 m}\n"
        "  - {id: b, label: window, require: a > 2 m}\n";
    CHECK(has(findings(pack_with(rules)), "R255"));
    CHECK(findings(pack_with(rules + "decide: {ambiguous_below: 0.1, evidence: 0.05}\n")).empty());
  }
}
