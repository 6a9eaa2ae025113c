#pragma once

#include "cli/intake.h"
#include "kernel/io/output_file.h"
#include "kernel/model/issue.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// What a status file says beside the counts of failures.
struct Account {
  std::vector<std::string> inputs;
  std::string rules_sha256;  ///< empty without rules
  std::string config_sha256;
  int buildings = 0;
  int set_aside = 0;
  /// Features by label ("" = unknown).
  std::map<std::string, int> labels;
  int exit_code = 0;
};

/// Keeps book of what a command has set aside, so that nothing is lost: `STEM.quarantine.jsonl` has
/// one line for every record that failed, with the line of a CityJSONSeq as it was read, and
/// `STEM.status.json` has the counts (docs/formats.md). Both appear when all is done.
class Ledger {
 public:
  explicit Ledger(const std::string& stem);

  /// A record with buildings that were set aside, or that could not be read at all.
  void add(const Arrival& arrival, const std::vector<Issue>& errors);
  /// An input that could not be read.
  void add_unread(const std::string& input, const Issue& error);

  void commit(const Account& account);

 private:
  void append(const std::string& input, int line, const std::vector<Issue>& errors,
              std::string_view record);

  std::string status_file_;
  OutputFile quarantine_;
  std::map<std::string, int> codes_;  ///< records, by the code of their first error
  int records_ = 0;
};

}  // namespace oriel::cli
