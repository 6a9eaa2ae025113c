#pragma once

#include "cli/batch/intake.h"
#include "cli/batch/journal.h"
#include "kernel/base/issue.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/files/partial_files.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// Where records went: read = passed on + refused + not selected.
struct Records {
  std::size_t read = 0, refused = 0, not_selected = 0;
  std::size_t passed_on = 0;
};

/// What a status file says beside the counts of failures.
struct Account {
  std::vector<std::string> inputs;
  std::string rules_sha256;  ///< empty without rules
  std::string config_sha256;
  std::string command_sha256;  ///< empty without --resume
  /// By name, of inputs that were read to their end.
  std::map<std::string, std::string> input_sha256;
  FileMarks outputs;
  /// Records of streams, and of other inputs those that Reader gives.
  Records records;
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

  /// What the ledger knows beside its file, there and back.
  [[nodiscard]] nlohmann::ordered_json state() const;
  void restore(const nlohmann::ordered_json& state);

  /// Puts the quarantine in its place.
  void close() { quarantine_.commit(); }
  /// Behind all other outputs, which the status names.
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
