#pragma once

#include "kernel/io/files/partial_files.h"

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace oriel::cli {

/// How far a run has come, in a file beside its outputs: a line for outputs that are done,
/// inputs that are read, and each state the run was in. A line that was cut off by the end of the
/// program does not count.
class Journal {
 public:
  explicit Journal(std::string path) : path_(std::move(path)) {}
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The last state; nothing if there is no journal.
  std::optional<nlohmann::ordered_json> load();
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
  void open(bool is_fresh);
  void append(const std::string& text);
  void compact(const std::string& state);

  std::string path_;
  int descriptor_ = -1;
  std::size_t bytes_ = 0;
  FileMarks done_, read_;
};

/// {"bytes","lines","sha256"} by path, there and back.
nlohmann::ordered_json to_json(const FileMarks& marks);
FileMarks marks_of(const nlohmann::ordered_json& json);

}  // namespace oriel::cli
