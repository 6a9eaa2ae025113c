#include "cli/batch/inputs/input_reader.h"

#include "cli/batch/inputs/input_files.h"
#include "cli/terminal/file_advice.h"
#include "kernel/base/issue.h"
#include "kernel/base/sha256.h"

#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

std::optional<InputEvent> InputReader::next() {
  const bool is_at_start = input_ == start_.input;
  auto event = next_unchecked();
  if (!event || !is_at_start || !has_changed(*event)) return event;
  Issue issue;
  issue.code = Code::E117;
  issue.sentence =
      fmt::format("does not begin as it did when the run began; delete {}.journal to start again",
                  options_.status_stem);
  issue.place.file = options_.inputs[start_.input];
  throw InputError(std::move(issue));
}

/// The input at the start has other bytes there, or fewer records, than when the run was killed.
bool InputReader::has_changed(const InputEvent& event) const {
  if (const auto* record = std::get_if<Record>(&event))
    return record->number == start_.records && record->sha256 != start_.sha256;
  if (const auto* end = std::get_if<InputEnd>(&event)) return end->records < start_.records;
  if (const auto* failure = std::get_if<InputFailure>(&event))
    return failure->records < start_.records;
  return false;
}

std::optional<InputEvent> InputReader::next_unchecked() {
  try {
    if (reader_) return read();
    if (input_ == options_.inputs.size()) return std::nullopt;
    return open();
  } catch (const InputError& error) {
    auto failure = finish<InputFailure>();
    failure.issue = with_file_advice(error.issue());
    return failure;
  }
}

InputEvent InputReader::open() {
  const std::string& input = options_.inputs[input_];
  refuse_folder(input);
  ReadOptions options = options_.read_options(input);
  options.wants_sha256 = !options_.status_stem.empty();
  reader_ = std::make_unique<Reader>(input, options);
  records_ = 0;
  is_first_ = is_readable_ = true;
  return InputBegin{input_};
}

InputEvent InputReader::read() {
  Timings timings;
  auto document = timings.measure(Stage::read, [&] { return reader_->next(); });
  if (!document) {
    std::string sha256 = reader_->sha256();
    auto end = finish<InputEnd>();
    end.is_whole = is_readable_;
    end.sha256 = std::move(sha256);
    return end;
  }
  Record record = described(std::move(*document));
  record.timings = timings;
  return record;
}

Record InputReader::described(Checked<Document> document) {
  Record record;
  record.input = input_;
  record.input_name = options_.inputs[input_];
  record.number = ++records_;
  record.bytes = bytes();
  record.was_done = input_ == start_.input && records_ <= start_.records;
  if (!options_.status_stem.empty()) record.sha256 = reader_->sha256();
  const bool is_stream = reader_->format() == Format::cityjson_seq;
  if (is_stream) record.line = reader_->line();
  // A line of a stream costs that line; a file as a whole, or a stream's header, costs the input.
  record.is_one_of_many = is_stream && !is_first_;
  if (!document.value && !record.is_one_of_many) is_readable_ = false;
  if (!document.value && is_stream) record.refused = reader_->refused_line();
  record.is_header = is_first_ && reader_->format() != Format::cityjson;
  is_first_ = false;
  record.document = std::move(document);
  if (!options_.reuse.empty() && is_stream && record.document.value) {
    if (record.is_header)
      header_sha256_ = sha256(source_line(*record.document.value));
    else
      record.header_sha256 = header_sha256_;
  }
  return record;
}

/// InputEnd or InputFailure of the input at hand; the next one follows.
template <class Last>
Last InputReader::finish() {
  Last last;
  last.input = input_;
  last.input_name = options_.inputs[input_];
  last.records = records_;
  last.bytes = bytes();
  ++input_;
  records_ = 0;
  bytes_before_ = last.bytes;
  reader_.reset();
  return last;
}

}  // namespace oriel::cli
