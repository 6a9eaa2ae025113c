#pragma once

#include "cli/batch/run_options.h"
#include "cli/terminal/exit_code.h"
#include "io/files/partial_files.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::cli {

/// How far a run has come, in a file next to its outputs: a line for outputs that are done,
/// inputs that are read, and each state the run was in. A line that was cut off by the end of the
/// program does not count.
class Journal {
 public:
  explicit Journal(std::string path) : path_(std::move(path)) {}
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// From now on no other process can write it, or resume from it. False if another run has begun
  /// it. Throws OutputError E601.
  [[nodiscard]] bool begin();
  /// Forgets what another run has begun.
  void clear();
  /// The last state; nothing if there is none. Throws InputError E117 for a line that oriel does
  /// not write.
  std::optional<nlohmann::ordered_json> load();
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Outputs that are done so far.
  [[nodiscard]] const FileMarks& done() const { return done_; }
  /// Inputs that are read so far, with their SHA-256.
  [[nodiscard]] const FileMarks& read() const { return read_; }

  /// Notes that outputs are done and inputs read, and the state. Nothing is waited for: what was
  /// written survives the end of the program, not that of the machine. Throws OutputError E601.
  void write(const FileMarks& done, const FileMarks& read, const nlohmann::ordered_json& state);
  /// The run is over: nothing is left of the journal.
  void remove();

 private:
  void append(const std::string& text);
  void compact(const std::string& state);

  std::string path_;
  int descriptor_ = -1;
  bool is_new_ = false;               ///< nothing was ever written to it
  std::optional<std::size_t> bytes_;  ///< written by this run; nothing before the first
  FileMarks done_, read_;
};

/// A whole number from 0 on; of another value ordered_json::exception.
std::uint64_t count_of(const nlohmann::ordered_json& json);
/// Says what is wrong, without the number that the library puts before it.
std::string reason_of(const nlohmann::ordered_json::exception& error);
/// Whole numbers by name.
std::map<std::string, int> counts_of(const nlohmann::ordered_json& json);

/// {"bytes","lines","sha256"} by path, there and back.
nlohmann::ordered_json to_json(const FileMarks& marks);
FileMarks marks_of(const nlohmann::ordered_json& json);

/// Where a run stands in its inputs.
struct InputPosition {
  std::size_t input = 0;
  std::size_t records = 0;  ///< of that input
  std::string sha256;       ///< of what was read of it
};

/// What the state in a journal says of the run, besides what came of it (run_state_of). Throws
/// ordered_json::exception if it is none that oriel wrote.
struct JournalState {
  std::string command;
  InputPosition position;
  FileMarks files;  ///< that were open
};
JournalState journal_state_of(const nlohmann::ordered_json& json);

/// E117 for a journal that was changed since oriel wrote it.
InputError damaged_journal(const std::string& path);

/// A run of a command that may be killed at any moment, after which the same command with --resume
/// goes on after its last whole record. What it needs to know stands in STEM.journal; outputs grow
/// as PATH.partial and come to their place by rename.
class Resume {
 public:
  /// `settings` (hashes of all that a result depends on besides input and program) and the command
  /// line say whether it is the same run. Without --resume it begins anew. Throws InputError E117
  /// if the journal is that of another command or damaged, or the outputs that it names are not
  /// there.
  Resume(const RunOptions& options, const std::string& settings);

  /// What went before: empty for a run that begins.
  [[nodiscard]] const std::optional<nlohmann::ordered_json>& state() const { return state_; }
  [[nodiscard]] const InputPosition& position() const { return position_; }
  [[nodiscard]] const std::string& path() const { return journal_.path(); }
  /// The exit code of a run that is over, if its inputs and outputs still have their hashes.
  [[nodiscard]] std::optional<ExitCode> finished() const;

  /// A record, or an input, is done. Files that are open are written so far.
  void note(const InputPosition& position, nlohmann::ordered_json state);
  /// An input is read to its end.
  void note_read(const std::string& input, const std::string& sha256);
  void remove() { journal_.remove(); }

  /// Files that were put in their place, and inputs that were read, by this run and those before.
  [[nodiscard]] FileMarks done() const;
  [[nodiscard]] FileMarks read() const;
  [[nodiscard]] const std::string& command_sha256() const { return command_sha256_; }

 private:
  const RunOptions& options_;
  Journal journal_;
  std::string command_sha256_;
  std::optional<nlohmann::ordered_json> state_;
  InputPosition position_;
  FileMarks read_;  ///< since the last note
};

/// The SHA-256 of the program that runs.
std::string program_sha256();
/// That of a file, empty if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace oriel::cli
