#pragma once

#include "cli/terminal/issue_sums.h"
#include "kernel/base/issue.h"
#include "kernel/base/log.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace oriel::cli {

/// How much goes to stderr, and in which form.
struct LogOptions {
  /// trace, debug, info, warn, error or off. Empty: findings and summaries of the command, and
  /// warnings of the library.
  std::string level;
  /// A JSON object on each line; else text.
  bool is_json = false;
};

/// Adds `--log-level` and `--log-json` to a command, or to those below it if it has such.
void add_log_arguments(CLI::App& command, LogOptions& options);

/// All loggers of command and library write to stderr from now on. May be called again. In text the
/// lines of the library begin with level and logger; findings begin with their severity, in colours
/// only on a terminal and without NO_COLOR; what else the command says stands as it is.
void set_up_logging(const LogOptions& options);

/// Lines are JSON objects.
bool logs_json();

/// What the command found (Report), as a JSON object if logs_json(), else as text.
Log findings_log();
/// How far it is: JSON objects.
Log progress_log();
/// All else that the command says on stderr: summaries, files that were written.
Log run_log();

/// Reports to the user what was found (findings_log), and counts errors. Notes stand on level debug
/// unless they are asked for. What is found about the buildings of a city is summed by code
/// (IssueSums), unless notes are asked for, or JSON; the sums so far are the last words of a run
/// that ends at once.
class Report {
 public:
  explicit Report(bool is_verbose) : is_verbose_(is_verbose) {}
  /// Reports the sums that are left.
  ~Report();
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;

  void add(const std::vector<Issue>& issues);
  void add(const Issue& issue);
  /// The sums so far: no more of what they sum is to come.
  void finish();

  /// What an earlier part of the run has reported.
  void restore(std::map<std::string, int> errors) { errors_ = std::move(errors); }

  /// Errors so far, by code.
  [[nodiscard]] const std::map<std::string, int>& errors() const { return errors_; }

 private:
  /// True if it is summed.
  bool add_one(const Issue& issue);
  void write(const Issue& issue) const;
  void keep_sums_as_last_words() const;

  bool is_verbose_;
  std::map<std::string, int> errors_;
  IssueSums sums_;
};

}  // namespace oriel::cli
