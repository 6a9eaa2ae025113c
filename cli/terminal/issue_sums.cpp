#include "cli/terminal/issue_sums.h"

#include "kernel/base/text/counted.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// So many errors of a code are reported as they come: each costs a building.
constexpr std::size_t kErrorsShown = 5;

}  // namespace

IssueSums::Sum& IssueSums::sum_of(const Issue& issue) {
  const auto found = std::ranges::find_if(sums_, [&](const Sum& sum) {
    return sum.code == issue.code && sum.severity == issue.severity;
  });
  if (found != sums_.end()) return *found;
  Sum& sum = sums_.emplace_back();
  sum.severity = issue.severity;
  sum.code = issue.code;
  return sum;
}

bool IssueSums::keep(const Issue& issue) {
  if (issue.severity == Severity::note || issue.place.building.empty()) return false;
  Sum& sum = sum_of(issue);
  ++sum.count;
  if (sum.buildings == 0 || issue.place.building != sum.last_building) ++sum.buildings;
  sum.last_building = issue.place.building;
  if (issue.severity == Severity::error && sum.count <= kErrorsShown) return false;
  if (sum.findings.empty() || sum.buildings == 1) sum.findings.push_back(issue);
  return true;
}

Issue IssueSums::summed(const Sum& sum) {
  Issue first = sum.findings.front();
  Issue issue;
  issue.severity = sum.severity;
  issue.code = sum.code;
  first.code = Code::none;
  first.excerpt.clear();
  const bool is_error = sum.severity == Severity::error;
  const std::string all = counted(sum.buildings, "building");
  const std::string times = sum.count == sum.buildings ? "" : fmt::format(" ({} times)", sum.count);
  issue.sentence = is_error ? fmt::format("{} more of this kind, in {}{} altogether",
                                          sum.count - kErrorsShown, all, times)
                            : fmt::format("in {}{}, for example {}", all, times, to_string(first));
  return issue;
}

std::vector<Issue> IssueSums::so_far() const {
  std::vector<Issue> issues;
  for (const Sum& sum : sums_) {
    if (sum.findings.empty()) continue;
    const std::size_t reported = sum.severity == Severity::error ? kErrorsShown : 0;
    if (sum.findings.size() + reported == sum.count)
      issues.insert(issues.end(), sum.findings.begin(), sum.findings.end());
    else
      issues.push_back(summed(sum));
  }
  return issues;
}

std::vector<Issue> IssueSums::take() {
  std::vector<Issue> issues = so_far();
  sums_.clear();
  return issues;
}

}  // namespace oriel::cli
