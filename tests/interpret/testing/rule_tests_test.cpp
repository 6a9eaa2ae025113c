#include "interpret/testing/rule_tests.h"

#include "tests/interpret/support.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace oriel;
using namespace oriel::test;

namespace {

constexpr const char* kWindowsAndDoors =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "params: {low: {value: 0.6 m}}\n"
    "classes: {window: {}, door: {}}\n"
    "relations: {row: {within: same storey, where: base_height ~ other.base_height by 1 %}}\n"
    "rules:\n"
    "  - {id: w, label: window, require: sense = hole and base_height > $low}\n"
    "  - {id: d, label: door, require: [sense = hole, base_height <= $low], unless: [a < 1 m]}\n"
    "groups: {rows: {of: window, by: row, at_least: 2}}\n";

constexpr const char* kFixture =
    "tests_for: t.yaml\n"
    "fixtures:\n"
    "  front:\n"
    "    defaults: {facade: F, host: wall, sense: hole, a: 2 m}\n"
    "    features:\n"
    "      w: {repeat: {columns: 3, rows: 2, dx: 2 m, dz: 3 m}, base_height: 1 m}\n"
    "      d: {base_height: 0.1 m, x: 9 m}\n"
    "tests:\n";

BuildingReader no_buildings() {
  return [](const std::string&) { return Checked<std::vector<DescribedBuilding>>{}; };
}

Checked<RuleTestReport> run(const std::string& tests, const BuildingReader& read = no_buildings(),
                            const std::string& pack = kWindowsAndDoors) {
  static int count = 0;
  const auto folder = std::filesystem::temp_directory_path() /
                      fmt::format("oriel-rule-tests-{}-{}", ::getpid(), ++count);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "t.yaml") << pack;
  std::ofstream(folder / "t.test.yaml") << kFixture << tests;
  auto report = run_rule_tests((folder / "t.test.yaml").string(), read);
  std::filesystem::remove_all(folder);
  return report;
}

/// The failures of a file with that one test.
std::vector<std::string> failures(const std::string& test) {
  const auto checked = run("  - {name: t, " + test + "}\n");
  for (const Issue& issue : checked.issues) FAIL_CHECK(to_string(issue));
  REQUIRE(checked.value);
  REQUIRE(checked.value->tests.size() == 1);
  return checked.value->tests[0].failures;
}

std::string findings_of_test(const std::string& test) {
  std::string printed;
  const auto checked = run("  - {name: t, " + test + "}\n");
  CHECK_FALSE(checked.value);
  for (const Issue& issue : checked.issues) printed += to_string(issue) + "\n";
  return printed;
}

using Failures = std::vector<std::string>;

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a failed test names the features that are not as it expects") {
    const auto unexpected = [](const std::string& test) {
      const auto checked = run("  - {name: t, given: front, " + test + "}\n");
      REQUIRE(checked.value);
      std::vector<std::string> ids;
      for (const auto& [building, id] : checked.value->tests.at(0).unexpected) ids.push_back(id);
      return ids;
    };
    using Ids = std::vector<std::string>;
    CHECK(unexpected("expect: {w.*: window, d: door}").empty());
    CHECK(unexpected("expect: {w.1: door, d: door}") == Ids{"w.1"});
    CHECK(unexpected("expect: {w.2: unknown, w.1: not window}") == Ids{"w.1", "w.2"});
    CHECK(unexpected("expect: {d: door}, because: {w: holds}") == Ids{"d"});
    CHECK(unexpected("expect: {counts: {door: 0}}") == Ids{"d"});
    CHECK(unexpected("expect: {counts: {door: 2}}").empty());
  }

  TEST_CASE("expectations of labels counts and groups pass where they are met") {
    CHECK(failures("given: front, expect: {w.*: window, w.1: not door, d: door}").empty());
    CHECK(failures("given: front, expect: {counts: {window: 6, door: 1, unknown: 0}}").empty());
    CHECK(failures("given: front, expect: {groups: {rows: 2}}").empty());
    CHECK(failures("given: {front: {d.base_height: $low + 1 cm}}, expect: {d: window}").empty());
    CHECK(failures("given: {front: {d.sense: missing}}, expect: {d: unknown}").empty());
  }

  TEST_CASE("expectations that are not met say what was found") {
    CHECK(failures("given: front, expect: {d: window}") ==
          Failures{"d is door 1.00 by d, expected window"});
    CHECK(failures("given: front, expect: {w.1: not window}") ==
          Failures{"w.1 is window 1.00 by w, expected not window"});
    CHECK(failures("given: front, expect: {counts: {door: 2}}") ==
          Failures{"1 feature labelled door, expected 2"});
    CHECK(failures("given: front, expect: {groups: {rows: 3}}") ==
          Failures{"2 groups rows, expected 3"});
  }

  TEST_CASE("a test that matches nothing fails") {
    CHECK(failures("given: front, expect: {x.*: window}") == Failures{"nothing is called 'x.*'"});
    CHECK(failures("given: {building: none.json}, expect: {counts: {window: 0}}") ==
          Failures{"nothing was found in 'none.json'"});
    CHECK(findings_of_test("given: front").find("R270 this test expects nothing") !=
          std::string::npos);
    CHECK(findings_of_test("given: front, because: {w: holds}").find("R270") != std::string::npos);
  }

  TEST_CASE("tests that are no list are refused as such") {
    std::string printed;
    for (const Issue& issue : run("  t: {given: front}\n").issues) printed += to_string(issue);
    CHECK(printed.find("'tests'") != std::string::npos);
  }

  TEST_CASE("reasons are those that explain gives") {
    CHECK(failures("given: front, expect: {d: door}, because: {d: holds, w: fails}").empty());
    CHECK(
        failures("given: front, expect: {d: door}, because: {w: 'fails at \"base_height > $low\"'}")
            .empty());
    CHECK(failures("given: {front: {d.a: 0.5 m}}, expect: {d: unknown}, "
                   "because: {d: 'fails at \"a < 1 m\"'}")
              .empty());
    CHECK(failures("given: front, expect: {d: door}, because: {w: holds}") ==
          Failures{"d: w fails, expected that it holds"});
    CHECK(failures("given: front, expect: {d: door}, because: {w: 'fails at \"sense = hole\"'}") ==
          Failures{"d: w fails, expected that it fails at \"sense = hole\""});
  }

  TEST_CASE("a property holds for small noise and not for large") {
    CHECK(failures("given: front, property: {perturb: {base_height: 1 mm, a: 1 %}, times: 20}")
              .empty());
    const auto found = failures("given: front, property: {perturb: {base_height: 1 m}, times: 50}");
    REQUIRE(found.size() == 1);
    CHECK(found[0].starts_with("perturbation "));
    CHECK(found == failures("given: front, property: {perturb: {base_height: 1 m}, times: 50}"));
  }

  TEST_CASE("what a file of tests gets wrong is found with its place") {
    CHECK(findings_of_test("given: frond, expect: {d: door}").find("did you mean 'front'?") !=
          std::string::npos);
    CHECK(findings_of_test("given: front, expect: {d: dor}").find("R205") != std::string::npos);
    CHECK(findings_of_test("given: {front: {x.a: 1 m}}, expect: {d: door}").find("R212") !=
          std::string::npos);
    CHECK(findings_of_test("given: {front: {d.heigth: 1 m}}, expect: {d: door}").find("R204") !=
          std::string::npos);
    CHECK(findings_of_test("given: {front: {d.base_height: 1}}, expect: {d: door}").find("R231") !=
          std::string::npos);
    CHECK(findings_of_test("given: front, expects: {d: door}").find("R209") != std::string::npos);
  }

  TEST_CASE("coverage counts rules that held and conditions that held and failed") {
    const auto checked = run("  - {name: t, given: front, expect: {d: door}}\n");
    REQUIRE(checked.value);
    const RuleTestReport& report = *checked.value;
    REQUIRE(report.rules.size() == 2);
    CHECK(report.rules[0].held == 6);
    CHECK(report.rules[1].held == 1);
    CHECK(report.rule_coverage() == 1);
    // All are holes, and none is small.
    CHECK(report.condition_coverage() == doctest::Approx(2.0 / 5).epsilon(1e-12));
    CHECK(to_text(report).find("'a < 1 m' never holds") != std::string::npos);
  }

  TEST_CASE("own rules come first and coverage is theirs unless the base is asked for") {
    const std::string pack =
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "extends: residential\n"
        "params: {low: {value: 0.6 m}}\n"
        "classes: {opening_like: {}}\n"
        "relations: {row: {within: same storey, where: base_height ~ other.base_height by 1 %}}\n"
        "groups: {rows: {of: window, by: row, at_least: 2}}\n"
        "rules: [{id: mine, label: opening_like, require: [sense = hole, base_height > $low], "
        "priority: 999}]\n";
    const auto checked =
        run("  - {name: t, given: front, expect: {w.*: opening_like}}\n", no_buildings(), pack);
    for (const Issue& issue : checked.issues) CAPTURE(to_string(issue));
    REQUIRE(checked.value);
    const RuleTestReport& report = *checked.value;
    REQUIRE(report.rules.size() > 10);
    CHECK(report.rules[0].id == "mine");
    CHECK(report.rules[0].is_own);
    CHECK(report.rules[0].decided == 6);
    CHECK_FALSE(report.rules[1].is_own);
    CHECK(report.rule_count() == 1);
    CHECK(report.rule_count(CoverageOf::all_rules) == report.rules.size());
    CHECK(report.rule_coverage() == 1);
    CHECK(report.condition_coverage() == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(report.rule_coverage(CoverageOf::all_rules) < 0.5);
    const std::string own = to_text(report), all = to_text(report, CoverageOf::all_rules);
    CHECK(own.find("100.0 % of 1 rule held, 50.0 % of its conditions both held and failed") !=
          std::string::npos);
    CHECK(own.find("residential.yaml") == std::string::npos);
    CHECK(all.find("not covered by the tests:\n  mine: ") == 0);
    CHECK(all.find("not covered, of the packs that it extends:\n") != std::string::npos);
    CHECK(all.find(" rules with those it extends held") != std::string::npos);
  }

  TEST_CASE("what the tests never decide is said in words with what they do not give") {
    const std::string pack =
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "params: {low: {value: 0.6 m}}\n"
        "classes: {window: {}, door: {}}\n"
        "relations: {row: {within: same storey, where: base_height ~ other.base_height by 1 %}}\n"
        "groups: {rows: {of: window, by: row, at_least: 2}}\n"
        "rules:\n"
        "  - {id: w, label: window, require: [sense = hole, base_height > $low]}\n"
        "  - {id: v, label: window, require: base_height > $low, priority: -1}\n"
        "  - {id: d, label: door, require: [volume > 1 m3, host is wall], unless: [natural]}\n";
    const auto checked =
        run("  - {name: t, given: front, expect: {w.*: window}}\n", no_buildings(), pack);
    REQUIRE(checked.value);
    const std::string text = to_text(*checked.value);
    CAPTURE(text);
    CHECK(text.find("  v: holds, but never gives a feature its label: other rules win (") !=
          std::string::npos);
    CHECK(text.find("  d: never holds (") != std::string::npos);
    CHECK(text.find("  d: 'volume > 1 m3' is never decided: the tests give no feature a value for "
                    "volume (") != std::string::npos);
    CHECK(text.find("  d: 'natural' is never decided: the tests give no feature a value for "
                    "natural (") != std::string::npos);
    CHECK(text.find("  d: 'host is wall' never fails (") != std::string::npos);
  }

  TEST_CASE("results are written as JUnit XML without times") {
    const auto checked = run("  - {name: \"a <b>\", given: front, expect: {d: window}}\n");
    REQUIRE(checked.value);
    const std::string xml = to_junit({*checked.value});
    CHECK(xml.find("tests=\"1\" failures=\"1\"") != std::string::npos);
    CHECK(xml.find("name=\"a &lt;b&gt;\"") != std::string::npos);
    CHECK(xml.find("<failure message=\"d is door 1.00 by d, expected window\"/>") !=
          std::string::npos);
    CHECK(xml.find("time=") == std::string::npos);
  }

  TEST_CASE("a building is read by who can and tested like a fixture") {
    const BuildingReader read = [](const std::string& path) {
      CHECK(std::filesystem::path(path).filename() == "house.json");
      Scene scene;
      scene.add({{"sense", "hole"}, {"base_height", 2.0}});
      Checked<std::vector<DescribedBuilding>> found;
      found.value.emplace();
      found.value->push_back({scene.table(), scene.graph()});
      return found;
    };
    const auto checked = run(
        "  - {name: t, given: {building: house.json}, expect: {f0: window, counts: {window: 1}}}\n",
        read);
    REQUIRE(checked.value);
    CHECK(checked.value->failed() == 0);
  }

  TEST_CASE("what is close is tested as it is labelled with evidence") {
    const std::string pack =
        "schema: oriel/1\n"
        "pack: {name: t, version: 1.0.0}\n"
        "classes: {window: {}, door: {typical: {per building: 1 ..}}}\n"
        "rules:\n"
        "  - {id: w, label: window, require: sense = hole, score: [b: {fall: 1 m .. 2 m}]}\n"
        "  - {id: d, label: door, require: sense = hole, score: [b: {rise: 1 m .. 2 m}]}\n"
        "decide: {ambiguous_below: 0.2, evidence: 0.1}\n";
    const auto checked =
        run("  - {name: t, given: {front: {w.*.b: 1.2 m, d.b: 1.48 m}}, expect: {w.*: window, d: "
            "door}, "
            "because: {w: holds}}\n",
            no_buildings(), pack);
    REQUIRE(checked.value);
    REQUIRE(checked.value->tests.size() == 1);
    for (const std::string& failure : checked.value->tests[0].failures) FAIL_CHECK(failure);
  }

  TEST_CASE("the tests of the default pack pass and cover all its rules") {
    const auto checked = run_rule_tests(
        std::string(ORIEL_SOURCE_DIR) + "/rules/residential.test.yaml", no_buildings());
    for (const Issue& issue : checked.issues) FAIL_CHECK(to_string(issue));
    REQUIRE(checked.value);
    for (const RuleTestResult& test : checked.value->tests)
      for (const std::string& failure : test.failures) FAIL_CHECK((test.name + ": " + failure));
    CHECK(checked.value->rule_coverage() == 1);
    CHECK(checked.value->condition_coverage() >= 0.9);
  }
}
