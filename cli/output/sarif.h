#pragma once

#include "kernel/base/issue.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// Findings as a SARIF 2.1.0 log (OASIS, 2020) of one run, which code hosts show beside the lines:
/// each code is a rule with its section of docs/ as help, each finding a result with its file, line
/// and column, and the building and feature as logical location.
class SarifLog {
 public:
  void add(const Issue& issue) { issues_.push_back(issue); }
  void add(const std::vector<Issue>& issues) {
    issues_.insert(issues_.end(), issues.begin(), issues.end());
  }

  /// The log as JSON, in the order of the findings.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<Issue> issues_;
};

}  // namespace oriel::cli
