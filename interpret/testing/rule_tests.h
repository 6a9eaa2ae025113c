#pragma once

#include "interpret/pack/rule_base.h"
#include "model/description/feature_graph.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// Reads the buildings of a file for `given: {building: FILE}`; what cannot be read is an issue.
using BuildingReader =
    std::function<Checked<std::vector<DescribedBuilding>>(const std::string& path)>;

/// What came of one test.
struct RuleTestResult {
  std::string name;
  Place place;
  /// The file of the test's buildings; empty: its features are made by hand.
  std::string building;
  /// A sentence each; empty: the test has passed.
  std::vector<std::string> failures;
  /// Building and id of the features that are not as the test expects, sorted.
  std::vector<std::pair<std::string, std::string>> unexpected;
};

/// How often a condition of a rule held and failed, over all features of all tests.
struct ConditionCoverage {
  std::string text;
  Place place;
  std::size_t held = 0;
  std::size_t failed = 0;
  /// Of one that never held and never failed: the attributes without a value that it asks for.
  std::vector<std::string> missing;
  [[nodiscard]] bool is_covered() const { return held > 0 && failed > 0; }
};

struct RuleCoverage {
  std::string id;
  Place place;
  /// It stands in the pack under test, not in one that this pack extends.
  bool is_own = true;
  /// Its class is a predicate, of which a feature may have several.
  bool is_predicate = false;
  /// For how many features it held.
  std::size_t held = 0;
  /// How many features got their label from it; 0 of predicates.
  std::size_t decided = 0;
  /// Each condition of `require` and `unless`; what `and` joins counts as several.
  std::vector<ConditionCoverage> conditions;
};

/// Which rules coverage is about: those of the pack itself, or those of the packs that it extends,
/// too.
enum class CoverageOf { own_rules, all_rules };

struct RuleTestReport {
  /// The file of the tests.
  std::string file;
  /// The pack they are for; there always.
  std::optional<RuleBase> pack;
  /// In the order of the file.
  std::vector<RuleTestResult> tests;
  /// The pack's own rules, then those of the packs that it extends, each in their order.
  std::vector<RuleCoverage> rules;

  [[nodiscard]] std::size_t failed() const;
  [[nodiscard]] std::size_t rule_count(CoverageOf of = CoverageOf::own_rules) const;
  /// Shares, 0…1: of rules that held at least once, of conditions that held and failed; 1 of none.
  [[nodiscard]] double rule_coverage(CoverageOf of = CoverageOf::own_rules) const;
  [[nodiscard]] double condition_coverage(CoverageOf of = CoverageOf::own_rules) const;
};

/// Runs the tests in the file at `path` (docs/rules.md, "Testing"). A test file with findings of
/// its own, or of the pack it is for, has no report. `read` is called for buildings, with paths
/// that begin in the folder of the tests.
Checked<RuleTestReport> run_rule_tests(const std::string& path, const BuildingReader& read);

/// A line a failure, then what is not covered and why, own rules first, and the sums.
std::string to_text(const RuleTestReport& report, CoverageOf of = CoverageOf::own_rules);

/// Reports as JUnit XML, without times.
std::string to_junit(const std::vector<RuleTestReport>& reports);

}  // namespace oriel
