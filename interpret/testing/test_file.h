#pragma once

#include "interpret/explain/explain.h"
#include "interpret/language/findings.h"
#include "interpret/pack/rule_base.h"
#include "interpret/testing/fixture.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel::rules {

/// `w.*: window`, `d: not door`, `x: unknown`.
struct Expectation {
  std::string pattern;
  std::string label;
  bool is_negated = false;
};

/// `door.ground: fails at "base_height <= $sill_max"`.
struct Reason {
  std::string rule;
  Outcome outcome = Outcome::holds;
  /// The text of a condition as explain prints it; empty: the rule as a whole.
  std::string condition;
};

/// `property: {perturb: {base_height: 2 mm, a: 1 %}, times: 20}`.
struct TablePerturbation {
  struct Amount {
    Attribute attribute{};
    double amount = 0;
    /// A share of the value, not a distance.
    bool is_relative = false;
  };
  std::vector<Amount> amounts;
  int times = 20;
};

/// Numbers in -1 … 1 that are the same on every machine (splitmix64).
class Noise {
 public:
  double next();

 private:
  std::uint64_t state_ = 0x6f7269656c;
};

/// The table with each value moved by no more than its amount.
FeatureTable perturbed(const FeatureTable& table, const TablePerturbation& perturbation,
                       Noise& noise);

struct RuleTest {
  std::string name;
  Place place;
  /// A file, or empty: the fixture.
  std::string building;
  Fixture fixture;
  std::vector<Expectation> labels;
  std::vector<std::pair<std::string, std::size_t>> counts;
  std::vector<std::pair<std::string, std::size_t>> groups;
  std::vector<Reason> because;
  std::optional<TablePerturbation> perturbation;
};

struct TestFile {
  std::optional<RuleBase> base;
  std::vector<RuleTest> tests;
};

/// The tests at `path` and the pack they are for; nothing if there are errors among `issues`.
std::optional<TestFile> read_test_file(const std::string& path, std::vector<Issue>& issues);

/// What was read of the text of a file of tests.
struct ReadTests {
  std::optional<TestFile> file;  ///< nothing if there are errors
  /// Those of the tests, then those of the pack that are no notes.
  std::vector<Issue> issues;
  /// Those of the tests with their spans in the text.
  std::vector<SpannedFinding> findings;
};

/// The tests in `text`, which is to be the file at `path`.
ReadTests read_tests_text(std::string text, const std::string& path);

}  // namespace oriel::rules
