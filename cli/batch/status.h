#pragma once

#include "cli/batch/inputs/input_reader.h"
#include "cli/terminal/exit_code.h"
#include "io/files/output_file.h"
#include "io/files/partial_files.h"
#include "kernel/base/issue.h"

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace oriel::cli {

/// Where records went: read = passed on + refused + not selected.
struct RecordCounts {
  std::size_t read = 0, refused = 0, not_selected = 0;
  std::size_t passed_on = 0;
  [[nodiscard]] bool add_up() const { return read == passed_on + refused + not_selected; }
};

/// What came of a run so far.
struct RunState {
  int buildings = 0;
  int set_aside = 0;
  int open = 0;         ///< buildings that came to the end without a solid
  int featureless = 0;  ///< buildings that came to the end, in which no feature was found
  /// Features by label ("" = unknown).
  std::map<std::string, int> labels{};
  RecordCounts records{};
  ExitCode code = ExitCode::clean;
  /// Of the ids that were asked for those that are there.
  std::set<std::string> found_ids{};

  void raise(ExitCode graver_code) { code = graver(code, graver_code); }
};

/// A state as the journal of a run that can be resumed has it, there and back.
nlohmann::ordered_json to_json(const RunState& state);
RunState run_state_of(const nlohmann::ordered_json& json);

/// What a status file says of a run besides the counts of failures.
struct RunStatus {
  std::vector<std::string> inputs{};
  std::string rules_sha256{};  ///< empty without rules
  std::string config_sha256{};
  /// By name, of inputs that were read to their end.
  std::map<std::string, std::string> input_sha256{};
  FileMarks outputs{};
  RunState state{};
  std::string run_sha256{};  ///< empty of a run that cannot be resumed
};

inline constexpr const char* kStatusEnding = ".status.json";

/// The SHA-256 of a command and of what its status says it read, wrote and ended with, so that a
/// status that was changed is that of no run.
std::string run_sha256(const RunStatus& run, std::string_view command_sha256);

/// Reads STEM.status.json as far as other runs use it: hashes and marks of the files, the records,
/// the exit code and run_sha256. Throws InputError: what read_json_file says, E202 if oriel did not
/// write it.
RunStatus read_status(const std::string& path);

/// Writes what a command has set aside, so that nothing is lost: `STEM.quarantine.jsonl` has one
/// line for every record that failed, with the line of a CityJSONSeq as it was read, and
/// `STEM.status.json` has the counts (docs/formats.md). Both appear when all is done.
class StatusWriter {
 public:
  explicit StatusWriter(const std::string& stem);

  /// A record with buildings that were set aside, or that could not be read at all.
  void add(const Record& record, const std::vector<Issue>& errors);
  /// An input that could not be read.
  void add_unread(const std::string& input, const Issue& error);

  /// What the writer knows besides its file, there and back.
  [[nodiscard]] nlohmann::ordered_json state() const;
  void restore(const nlohmann::ordered_json& state);

  /// Puts the quarantine in its place.
  void close() { quarantine_.commit(); }
  /// After all other outputs, which the status names.
  void commit(const RunStatus& status);

 private:
  void append(const std::string& input, int line, const std::vector<Issue>& errors,
              std::string_view record);

  std::string status_file_;
  OutputFile quarantine_;
  std::map<std::string, int> codes_;  ///< records, by the code of their first error
  int records_ = 0;
};

}  // namespace oriel::cli
