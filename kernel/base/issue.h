#pragma once

#include "kernel/base/code.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

enum class Severity { note, warning, error };

/// Where a finding is: a place in a text (file, line, column; counted from 1, 0 = unknown), or a
/// place in a model (building, feature), or both.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  std::string building;
  std::string feature;
};

/// A finding about the user's data or rules: collected and returned, never thrown.
struct Issue {
  Severity severity = Severity::error;
  Code code = Code::none;
  std::string sentence;
  Place place;
  /// The source line and a caret under the place, or empty.
  std::string excerpt;
};

/// `file:line:col: CODE sentence`, or `building[ feature]: CODE sentence`, with the excerpt below
/// it on lines of its own. Parts that are unknown are left out.
std::string to_string(const Issue& issue);

/// "error", "warning" or "note".
std::string to_string(Severity severity);

/// An issue about a building as a whole.
Issue building_issue(Severity severity, Code code, const std::string& building,
                     std::string sentence);

/// True if one of `issues` is an error.
bool has_errors(const std::vector<Issue>& issues);

/// A value, if one could be made, and what was found on the way. A value may come with warnings;
/// without a value there is at least one error.
template <class T>
struct Checked {
  std::optional<T> value;
  std::vector<Issue> issues;
};

/// The call cannot be honoured because its input cannot be had (a file that is missing, a format
/// unknown). Caught once, in cli/main.cpp.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Issue issue)
      : std::runtime_error(to_string(issue)), issue_(std::move(issue)) {}
  [[nodiscard]] const Issue& issue() const { return issue_; }

 private:
  Issue issue_;
};

/// The result cannot be put where it was asked for (a folder that is read-only, a full disk).
class OutputError : public std::runtime_error {
 public:
  explicit OutputError(Issue issue)
      : std::runtime_error(to_string(issue)), issue_(std::move(issue)) {}
  [[nodiscard]] const Issue& issue() const { return issue_; }

 private:
  Issue issue_;
};

/// An invariant of a geometric algorithm does not hold; the building at hand is set aside with code
/// E901.
class GeometryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace oriel
