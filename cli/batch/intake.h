#pragma once

#include "cli/batch/outcome.h"
#include "cli/batch/resume.h"
#include "cli/commands/options.h"
#include "cli/terminal/timings.h"
#include "kernel/io/document.h"
#include "kernel/io/reader.h"
#include "oriel/result.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// What the inputs bring, one after the other: for each input that it begins, its records, that it
/// ends.
struct Arrival {
  enum class Kind { begin, record, end, failure };
  Kind kind = Kind::begin;
  std::size_t input = 0;
  std::string input_name{};
  /// Of a record of a stream, where it stands, from 1; else 0.
  int line = 0;
  /// The records of its input up to here, this one counted.
  std::size_t number = 0;
  /// Read up to here, of all inputs.
  std::uint64_t bytes = 0;
  /// With --resume of the input up to here; with --status of an input that was read to its end.
  std::string sha256{};
  /// An earlier run has done it.
  bool was_done = false;
  /// With --reuse, of a record behind the header of a stream: the hash of that header.
  std::string header_sha256{};
  /// … and that of header and line, with which its outcome is kept for later runs.
  std::string source_sha256{};
  /// Its outcome is that of an earlier run: there is nothing to work on.
  bool is_reused = false;
  /// Of a record. Without a value it could not be read.
  Checked<Document> record{};
  /// The line of a CityJSONSeq that has no value.
  std::string refused{};
  /// Of several records: what stands before the buildings.
  bool is_header = false;
  /// A record without a value costs itself only, and not its input.
  bool is_one_of_many = false;
  /// Of an end: all its records could be read.
  bool is_whole = true;
  /// Of a failure: the input could not be opened, or reading failed half-way. Nothing more of it
  /// comes.
  std::optional<Issue> issue{};
  /// With --isolate, of the record's buildings by number: working on it ended a worker.
  std::map<std::size_t, Issue> lost{};
  /// What came of the record; filled by the one who works on it.
  RecordOutcome outcome{};
  /// Its buildings on the line, in their order, for commands that visit them.
  std::vector<PipelineResult> lines{};
  /// What this record has taken so far.
  Timings timings{};
};

/// Reads the inputs of a command, in their order.
class Intake {
 public:
  /// Begins at `start`: inputs before it do not come, records before it come as done.
  explicit Intake(const LineArguments& arguments, Resume::Position start = {})
      : arguments_(arguments), start_(std::move(start)), input_(start_.input) {}

  /// The next arrival, or null after the last. Throws InputError E117 if what stands before the
  /// start is not what was read then.
  std::shared_ptr<Arrival> next();

 private:
  std::shared_ptr<Arrival> next_unchecked();
  std::shared_ptr<Arrival> open();
  std::shared_ptr<Arrival> read();
  std::shared_ptr<Arrival> finish(Arrival::Kind kind);
  [[nodiscard]] std::shared_ptr<Arrival> arrival(Arrival::Kind kind) const;

  const LineArguments& arguments_;
  [[nodiscard]] bool is_before_start() const {
    return input_ == start_.input && records_ <= start_.records;
  }

  Resume::Position start_;
  std::size_t input_ = 0;
  std::size_t records_ = 0;         ///< of the input
  std::uint64_t bytes_before_ = 0;  ///< of the inputs before it
  std::unique_ptr<Reader> reader_;
  std::string header_sha256_;
  bool is_first_ = true;     ///< record of its input
  bool is_readable_ = true;  ///< as a whole, so far
};

}  // namespace oriel::cli
