#include "interpret/testing/rule_tests.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/xml.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

std::string text_of(const Place& place) {
  return fmt::format("{}:{}:{}", printable(place.file), place.line, place.column);
}

std::string testcase(const RuleTestReport& report, const RuleTestResult& test) {
  std::string text =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" line=\"{}\"",
                  escaped_xml(report.pack->file()), escaped_xml(test.name),
                  escaped_xml(test.place.file), test.place.line);
  if (test.failures.empty()) return text + "/>\n";
  text += ">\n";
  for (const std::string& failure : test.failures)
    text += fmt::format("      <failure message=\"{}\"/>\n", escaped_xml(failure));
  return text + "    </testcase>\n";
}

/// What the tests never showed of a condition.
std::string gap_of(const ConditionCoverage& condition) {
  if (condition.held > 0) return "never fails";
  if (condition.failed > 0) return "never holds";
  if (condition.missing.empty()) return "is never decided: no feature of the tests answers it";
  return fmt::format("is never decided: the tests give no feature a value for {}",
                     fmt::join(condition.missing, ", "));
}

std::string gaps_of(const RuleCoverage& rule) {
  std::string text;
  const auto add = [&](const std::string& what, const Place& place) {
    text += fmt::format("  {}: {} ({})\n", printable(rule.id), what, text_of(place));
  };
  if (rule.held == 0)
    add("never holds", rule.place);
  else if (rule.decided == 0 && !rule.is_predicate)
    add("holds, but never gives a feature its label: other rules win", rule.place);
  for (const ConditionCoverage& condition : rule.conditions)
    if (!condition.is_covered())
      add(fmt::format("'{}' {}", printable(condition.text), gap_of(condition)), condition.place);
  return text;
}

/// What is not covered of the pack's own rules, or else of those that it takes over.
std::string gaps_of(const RuleTestReport& report, bool is_own) {
  std::string text;
  for (const RuleCoverage& rule : report.rules)
    if (rule.is_own == is_own) text += gaps_of(rule);
  return text;
}

/// "95.0 % of 20 rules held, 100.0 % of their conditions both held and failed".
std::string coverage_of(const RuleTestReport& report, CoverageOf of) {
  const std::size_t rules = report.rule_count(of);
  if (rules == 0) return "the pack has no rules of its own, --with-base counts those it extends";
  return fmt::format("{:.1f} % of {}{} held, {:.1f} % of {} conditions both held and failed",
                     report.rule_coverage(of) * 100, counted(rules, "rule"),
                     of == CoverageOf::all_rules ? " with those it extends" : "",
                     report.condition_coverage(of) * 100, agreeing(rules, "its", "their"));
}

}  // namespace

std::string to_text(const RuleTestReport& report, CoverageOf of) {
  std::string text;
  for (const RuleTestResult& test : report.tests)
    for (const std::string& failure : test.failures)
      text += fmt::format("{}: failed: {}: {}\n", text_of(test.place), printable(test.name),
                          printable(failure));
  const std::string own = gaps_of(report, true);
  if (!own.empty()) text += "not covered by the tests:\n" + own;
  const std::string base = of == CoverageOf::all_rules ? gaps_of(report, false) : "";
  if (!base.empty()) text += "not covered, of the packs that it extends:\n" + base;
  return text + fmt::format("{}: {} of {} passed; {}\n", printable(report.file),
                            report.tests.size() - report.failed(),
                            counted(report.tests.size(), "test"), coverage_of(report, of));
}

std::string to_junit(const std::vector<RuleTestReport>& reports) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const RuleTestReport& report : reports) {
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
                        escaped_xml(report.file), report.tests.size(), report.failed());
    for (const RuleTestResult& test : report.tests) text += testcase(report, test);
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

}  // namespace oriel
