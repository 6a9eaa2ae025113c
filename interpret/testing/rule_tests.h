#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/model/description/feature_graph.h"

#include <functional>
#include <string>
#include <vector>

namespace oriel {

/// Reads the buildings of a file for `given: {building: FILE}`; what cannot be read is an issue.
using BuildingReader =
    std::function<Checked<std::vector<DescribedBuilding>>(const std::string& path)>;

/// What came of one test.
struct RuleTestResult {
  std::string name;
  Place place;
  /// A sentence each; empty: the test has passed.
  std::vector<std::string> failures;
};

/// How often a condition of a rule held and failed, over all features of all tests.
struct ConditionCoverage {
  std::string text;
  Place place;
  std::size_t held = 0;
  std::size_t failed = 0;
  [[nodiscard]] bool is_covered() const { return held > 0 && failed > 0; }
};

struct RuleCoverage {
  std::string id;
  Place place;
  /// For how many features it held.
  std::size_t held = 0;
  /// Each condition of `require` and `unless`; what `and` joins counts as several.
  std::vector<ConditionCoverage> conditions;
};

struct RuleTestReport {
  /// The file of the tests and the pack they are for.
  std::string file;
  std::string pack;
  /// In the order of the file.
  std::vector<RuleTestResult> tests;
  /// In the order of the pack.
  std::vector<RuleCoverage> rules;

  [[nodiscard]] std::size_t failed() const;
  /// Shares, 0…1: of rules that held at least once, of conditions that held and failed; 1 of none.
  [[nodiscard]] double rule_coverage() const;
  [[nodiscard]] double condition_coverage() const;
};

/// Runs the tests in the file at `path` (docs/rules.md, "Testing"). A test file with findings of
/// its own, or of the pack it is for, has no report. `read` is called for buildings, with paths
/// that begin in the folder of the tests.
Checked<RuleTestReport> run_rule_tests(const std::string& path, const BuildingReader& read);

/// A line a failure, what is not covered, and the sums.
std::string to_text(const RuleTestReport& report);

/// Reports as JUnit XML, without times.
std::string to_junit(const std::vector<RuleTestReport>& reports);

}  // namespace oriel
