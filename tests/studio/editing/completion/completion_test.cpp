#include "tests/studio/editing/marked_text.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// kTown with `line` in place of the condition on the sill.
std::vector<std::string> completed_in_rule(const std::string& line) {
  std::string text = kTown;
  const std::string old = "self is opening and base_height >= $sill";
  text.replace(text.find(old), old.size(), line);
  return completed(text);
}

}  // namespace

TEST_SUITE("studio/editing") {
  TEST_CASE("a condition begins with attributes, macros, params and functions") {
    const auto labels = completed_in_rule("wid|");
    for (const char* label : {"width", "cut_in", "$sill", "exists", "abs", "not", "host is"})
      CHECK_MESSAGE(has(labels, label), label);
    CHECK_FALSE(has(labels, "label"));
    CHECK_FALSE(has(labels, "window"));
  }

  TEST_CASE("an attribute comes with its unit and its meaning") {
    const MarkedText at("rules:\n  - id: a\n    require:\n      - wid|\n");
    const auto completions = at.pack().complete(at.offset);
    const auto width = std::ranges::find(completions, "width", &Completion::label);
    REQUIRE(width != completions.end());
    CHECK(width->kind == "attribute");
    CHECK(width->detail == "m");
    CHECK(width->documentation.find("horizontal extent") != std::string::npos);
    CHECK(at.text.substr(width->replaced.begin, width->replaced.end - width->replaced.begin) ==
          "wid");
  }

  TEST_CASE("what comes next in an expression depends on what is before it") {
    CHECK(completed_in_rule("self is |") == std::vector<std::string>{"opening", "window", "door"});
    CHECK(has(completed_in_rule("host is |"), "roof"));
    CHECK(completed_in_rule("width >= $|") == std::vector<std::string>{"$sill", "$wide"});
    CHECK(completed_in_rule("width >= $s|").front() == "$sill");
    CHECK(completed_in_rule("sense = |") ==
          std::vector<std::string>{"protrusion", "hole", "cavity", "imprint"});
    CHECK(has(completed_in_rule("sense in [hole, |"), "cavity"));
    const auto relations = completed_in_rule("exists(|");
    CHECK(relations.front() == "close");
    CHECK(has(relations, "same_facade"));
    CHECK_FALSE(has(relations, "width"));
    CHECK(completed_in_rule("exists(close |") == std::vector<std::string>{"where"});
    CHECK(has(completed_in_rule("exists(close where |"), "is"));
    CHECK(has(completed_in_rule("width > 3 |"), "m"));
    CHECK(has(completed_in_rule("width > 3 m |"), "and"));
    CHECK_FALSE(has(completed_in_rule("width > 3 m |"), "width"));
    CHECK(completed_in_rule("a ~ b |") == std::vector<std::string>{"by"});
    CHECK(has(completed_in_rule("max(width of |"), "close"));
    CHECK(completed_in_rule("width > 3|").empty());
    CHECK(completed_in_rule("exists(close where distance_along(|") ==
          std::vector<std::string>{"other"});
  }

  TEST_CASE("completion works in texts that cannot be read") {
    const std::string begin = "params:\n  sill: {value: 0.9 m\n  other {\nclasses: {window: {}}\n";
    CHECK(has(completed(begin + "rules:\n  - {id: a, label: |"), "window"));
    CHECK(
        has(completed(begin + "rules:\n  - {id: a, label: window, require: \"width > |"), "width"));
    CHECK(has(
        completed(begin + "rules:\n - id: a\n   label: window\n   require: [host is |\n - id: b"),
        "wall"));
    CHECK(has(completed("classes:\n  a: {is: }\n\tb\nrules:\n- id: a\n  lab|"), "label"));
  }

  TEST_CASE("keys are those of the section that are not there yet") {
    const auto top = completed("schema: oriel/1\npack: {name: a, version: 1.0.0}\n|\nrules: []\n");
    CHECK(has(top, "params"));
    CHECK_FALSE(has(top, "pack"));
    CHECK_FALSE(has(top, "rules"));
    const auto rule = completed("rules:\n  - id: a\n    |\n    require: [a > 1 m]\n");
    CHECK(rule == std::vector<std::string>{"label", "priority", "unless", "score", "remove"});
    CHECK(has(completed("params:\n  sill: {value: 1 m, |}\n"), "range"));
    CHECK(has(completed("generalise:\n  - do: {|"), "enlarge"));
    CHECK(has(completed("generalise:\n  - do: {enlarge: {|"), "anchor"));
    CHECK(has(completed("hosts:\n  |"), "ground_reach"));
  }

  TEST_CASE("values are those of their place") {
    CHECK(completed("classes:\n  a: {abstract: |") == std::vector<std::string>{"true", "false"});
    CHECK(has(completed("generalise:\n  - do: |"), "omit"));
    CHECK(has(completed("extends: |"), "residential"));
    CHECK(has(completed("emit:\n  a: {type: |"), "BuildingInstallation"));
    std::string town = kTown;
    CHECK(has(completed(town.replace(town.find("for: window"), 11, "for: |")), "group row"));
    CHECK(has(completed("surfaces:\n  - id: a\n    when: |"), "facing"));
    CHECK(has(completed("generalise:\n  - id: a\n    when: a < 0.5 |"), "mm@map"));
    CHECK(has(completed("emit:\n  |\nclasses: {door: {}}\n"), "door"));
  }

  TEST_CASE("names of the packs beneath are offered") {
    const std::string begin = "schema: oriel/1\nextends: residential\n";
    CHECK(has(completed(begin + "rules:\n  - id: a\n    label: |"), "chimney"));
    CHECK(has(completed(begin + "rules:\n  - id: a\n    require: width > $|"), "$parapet"));
    CHECK(has(completed(begin + "params:\n  |"), "parapet"));
  }

  TEST_CASE("tests of a pack are completed with its classes, rules and attributes") {
    const std::string begin =
        "tests_for: residential\nfixtures:\n  front: {}\ntests:\n  - name: a\n";
    CHECK(has(completed(begin + "    given: |"), "front"));
    CHECK(has(completed(begin + "    expect: {w: |"), "window"));
    CHECK(has(completed(begin + "    because: {|"), "opening.in_wall"));
    CHECK(has(completed("tests_for: residential\nfixtures:\n  a:\n    features:\n      w: {|"),
              "base_height"));
    CHECK(has(completed(begin + "    |"), "expect"));
  }

  TEST_CASE("nothing is completed in comments") {
    CHECK(completed("rules:\n  - id: a   # lab|").empty());
    CHECK(completed("# |").empty());
  }

  TEST_CASE("whatever stands before and after a place it is answered") {
    for (std::size_t end = 0; end <= kTown.size(); end += 3) {
      const EditedPack cut(kTown.substr(0, end), "town.yaml");
      (void)cut.complete(end);
      const EditedPack whole(kTown, "town.yaml");
      for (const Completion& completion : whole.complete(end)) {
        REQUIRE(completion.replaced.begin <= end);
        REQUIRE(completion.replaced.end == end);
      }
    }
  }

  TEST_CASE("keys of profiles and tests are completed and say what they mean") {
    const std::string profile = "schema: oriel-profile/1\nprofile: {name: p, version: 1.0.0}\n";
    const auto keys = completed(profile + "levels:\n  \"2\":\n    form: as-is\n    |\n");
    CHECK(has(keys, "least-piece-m2"));
    CHECK_FALSE(has(keys, "form"));
    CHECK(completed(profile + "levels:\n  \"2\":\n    form: |\n") ==
          std::vector<std::string>{"as-is", "block", "blocks"});
    CHECK(has(completed("tests_for: residential\ntests:\n  - name: n\n    |\n"), "because"));
    for (const std::string& marked :
         {profile + "levels:\n  \"2\":\n    fo|rm: block\n",
          std::string("tests_for: residential\ntests:\n  - na|me: n\n")}) {
      const MarkedText at(marked);
      const auto hover = at.pack().hover(at.offset);
      REQUIRE(hover);
      CHECK(hover->text.size() > 8);
    }
  }
}
