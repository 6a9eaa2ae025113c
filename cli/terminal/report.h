#pragma once

#include "kernel/base/issue.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

/// Reports to the user what was found (findings_log), and counts errors. Notes stand on level debug
/// unless they are asked for.
class Report {
 public:
  explicit Report(bool is_verbose) : is_verbose_(is_verbose) {}

  void add(const std::vector<Issue>& issues);
  void add(const Issue& issue);

  /// What an earlier part of the run has reported.
  void restore(std::map<std::string, int> errors) { errors_ = std::move(errors); }

  /// Errors so far, by code.
  [[nodiscard]] const std::map<std::string, int>& errors() const { return errors_; }

 private:
  bool is_verbose_;
  std::map<std::string, int> errors_;
};

/// Rows of texts in columns, the first row as a head; numbers to the right.
std::string table(const std::vector<std::vector<std::string>>& rows);

}  // namespace oriel::cli
