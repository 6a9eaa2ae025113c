#pragma once

#include "cli/batch/resume.h"
#include "cli/batch/run_options.h"
#include "cli/terminal/timings.h"
#include "oriel/read.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace oriel::cli {

/// An input is open; its records follow.
struct InputBegin {
  std::size_t input = 0;
};

/// One record of an input: a whole file, or a line of a stream.
struct Record {
  std::size_t input = 0;
  std::string input_name{};
  /// The records of its input up to here, this one counted.
  std::size_t number = 0;
  /// Read up to here, of all inputs.
  std::uint64_t bytes = 0;
  /// Without a value it could not be read.
  Checked<Document> document{};
  /// Of a record of a stream, its line, from 1; else 0.
  int line = 0;
  /// The line of a CityJSONSeq that has no value.
  std::string refused{};
  /// Of several records: what stands before the buildings.
  bool is_header = false;
  /// A record without a value costs itself only, and not its input.
  bool is_one_of_many = false;
  /// An earlier run has done it.
  bool was_done = false;
  /// With --status: of the input up to here.
  std::string sha256{};
  /// With --reuse, of a record after the header of a stream: the hash of that header.
  std::string header_sha256{};
  /// How long reading it took.
  Timings timings{};
};

/// An input was read to its end.
struct InputEnd {
  std::size_t input = 0;
  std::string input_name{};
  std::size_t records = 0;
  std::uint64_t bytes = 0;
  /// All its records could be read.
  bool is_whole = true;
  std::string sha256{};  ///< with --status
};

/// An input could not be opened, or reading failed half-way. Nothing more of it comes.
struct InputFailure {
  std::size_t input = 0;
  std::string input_name{};
  std::size_t records = 0;  ///< that were read before
  std::uint64_t bytes = 0;
  Issue issue{};
};

using InputEvent = std::variant<InputBegin, Record, InputEnd, InputFailure>;

/// Reads the inputs of a command, in their order.
class InputReader {
 public:
  /// Begins at `start`: inputs before it do not come, records before it come as done.
  explicit InputReader(const RunOptions& options, InputPosition start = {})
      : options_(options), start_(std::move(start)), input_(start_.input) {}

  /// What comes next, or nothing after the last input. Throws InputError E117 if what stands before
  /// the start is not what was read then.
  std::optional<InputEvent> next();

 private:
  std::optional<InputEvent> next_unchecked();
  InputEvent open();
  InputEvent read();
  Record described(Checked<Document> document);
  template <class Last>
  Last finish();
  [[nodiscard]] bool has_changed(const InputEvent& event) const;
  [[nodiscard]] std::uint64_t bytes() const {
    return bytes_before_ + (reader_ ? reader_->bytes_read() : 0);
  }

  const RunOptions& options_;
  InputPosition start_;
  std::size_t input_ = 0;
  std::size_t records_ = 0;         ///< of the input
  std::uint64_t bytes_before_ = 0;  ///< of the inputs before it
  std::unique_ptr<Reader> reader_;
  std::string header_sha256_;
  bool is_first_ = true;     ///< record of its input
  bool is_readable_ = true;  ///< as a whole, so far
};

}  // namespace oriel::cli
