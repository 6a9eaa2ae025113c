#include "interpret/testing/rule_tests.h"
#include "kernel/base/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string text_of(const Place& place) {
  return fmt::format("{}:{}:{}", printable(place.file), place.line, place.column);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:  // XML has no way to write other control characters
        out += static_cast<unsigned char>(c) < 0x20U ? printable({&c, 1}) : std::string(1, c);
    }
  }
  return out;
}

std::string testcase(const RuleTestReport& report, const RuleTestResult& test) {
  std::string text = fmt::format(
      "    <testcase classname=\"{}\" name=\"{}\" file=\"{}\" line=\"{}\"", escaped(report.pack),
      escaped(test.name), escaped(test.place.file), test.place.line);
  if (test.failures.empty()) return text + "/>\n";
  text += ">\n";
  for (const std::string& failure : test.failures)
    text += fmt::format("      <failure message=\"{}\"/>\n", escaped(failure));
  return text + "    </testcase>\n";
}

std::string uncovered(const RuleCoverage& rule) {
  std::string text;
  if (rule.held == 0)
    text += fmt::format("  {}: never holds ({})\n", printable(rule.id), text_of(rule.place));
  for (const ConditionCoverage& condition : rule.conditions) {
    if (condition.is_covered()) continue;
    const char* what = condition.held > 0     ? "never fails"
                       : condition.failed > 0 ? "never holds"
                                              : "is never known";
    text += fmt::format("  {}: '{}' {} ({})\n", printable(rule.id), printable(condition.text), what,
                        text_of(condition.place));
  }
  return text;
}

}  // namespace

std::string to_text(const RuleTestReport& report) {
  std::string text;
  for (const RuleTestResult& test : report.tests)
    for (const std::string& failure : test.failures)
      text += fmt::format("{}: failed: {}: {}\n", text_of(test.place), printable(test.name),
                          printable(failure));
  std::string gaps;
  for (const RuleCoverage& rule : report.rules) gaps += uncovered(rule);
  if (!gaps.empty()) text += "not covered:\n" + gaps;
  return text + fmt::format(
                    "{}: {} of {} tests passed; {:.1f} % of rules held, {:.1f} % of "
                    "conditions held and failed\n",
                    printable(report.file), report.tests.size() - report.failed(),
                    report.tests.size(), report.rule_coverage() * 100,
                    report.condition_coverage() * 100);
}

std::string to_junit(const std::vector<RuleTestReport>& reports) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  for (const RuleTestReport& report : reports) {
    text += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
                        escaped(report.file), report.tests.size(), report.failed());
    for (const RuleTestResult& test : report.tests) text += testcase(report, test);
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

}  // namespace oriel
