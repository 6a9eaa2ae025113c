#include "interpret/compile/emitted.h"

#include "tests/interpret/support.h"

#include <algorithm>

using namespace oriel;
using namespace oriel::test;

namespace {

std::vector<Issue> issues_of(const std::string& sections) {
  auto checked =
      load_pack("schema: oriel/1\npack: {name: t, version: 1.0.0}\n" + sections, "t.yaml");
  CHECK(checked.value);
  return checked.issues;
}

constexpr const char* kRules =
    "rules:\n"
    "  - {id: w, label: window, require: natural}\n"
    "  - {id: c, label: chimney, require: not natural}\n";

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a label without emit is noted with the place of its class") {
    const auto issues = issues_of(std::string("classes: {window: {}, chimney: {}}\n") + kRules);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].severity == Severity::note);
    CHECK(to_string(issues[0]) ==
          "t.yaml:3:23: R258 a feature with the label 'chimney' is written to files of buildings "
          "without a type, a protrusion as a generic BuildingInstallation, anything else by "
          "the label of its surfaces: the class has no 'emit'; add emit: {chimney: {type: "
          "BuildingInstallation}}\n"
          "classes: {window: {}, chimney: {}}\n"
          "                      ^~~~~~~");
  }

  TEST_CASE("a label with emit of its own or of a class above it is written") {
    const std::string classes =
        "classes: {window: {}, part: {abstract: true}, chimney: {is: part}}\n";
    for (const char* emitting : {"chimney", "part"}) {
      CAPTURE(emitting);
      const std::string emit =
          fmt::format("emit: {{{}: {{type: BuildingInstallation}}}}\n", emitting);
      CHECK(issues_of(classes + kRules + emit).empty());
    }
    // Windows and doors are written anyway, and so is what they are above.
    CHECK(
        issues_of(std::string("classes: {window: {}, chimney: {is: window}}\n") + kRules).empty());
  }

  TEST_CASE("only labels that rules give are noted") {
    CHECK(issues_of(std::string("classes: {window: {}, chimney: {abstract: true}, vent: {}}\n") +
                    kRules)
              .empty());
  }

  TEST_CASE("what a pack beneath does not emit is no finding of the pack upon it") {
    const std::string over = "extends: residential\nclasses: {tower: {}}\n";
    CHECK(issues_of(over + "rules: [{id: b, label: bay, require: natural}]\n").empty());
    const auto issues =
        issues_of(over + "rules: [{id: t, label: tower, require: [natural, a > 10 m]}]\n");
    REQUIRE(std::ranges::count(issues, Code::R258, &Issue::code) == 1);
  }

  TEST_CASE("every pack that is built in writes all its labels") {
    for (const std::string& name : embedded_packs()) {
      CAPTURE(name);
      for (const Issue& issue : load_pack_file(name).issues) CHECK(issue.code != Code::R258);
    }
  }
}
