#include "cli/batch/intake.h"

#include "kernel/base/issue.h"
#include "kernel/base/sha256.h"

#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

std::shared_ptr<Arrival> Intake::next() {
  const bool is_at_start = input_ == start_.input;
  auto arrival = next_unchecked();
  if (!arrival || !is_at_start) return arrival;
  const bool has_changed =
      arrival->kind == Arrival::Kind::record
          ? arrival->number == start_.records && arrival->sha256 != start_.sha256
          : arrival->kind != Arrival::Kind::begin && arrival->number < start_.records;
  if (!has_changed) return arrival;
  Issue issue;
  issue.code = Code::E117;
  issue.sentence =
      fmt::format("does not begin as it did when the run began; delete {}.journal to begin anew",
                  arguments_.status_stem);
  issue.place.file = arrival->input_name;
  throw InputError(std::move(issue));
}

std::shared_ptr<Arrival> Intake::next_unchecked() {
  try {
    if (!reader_) return input_ < arguments_.inputs.size() ? open() : nullptr;
    return read();
  } catch (const InputError& error) {
    auto failure = finish(Arrival::Kind::failure);
    failure->issue = error.issue();
    return failure;
  }
}

std::shared_ptr<Arrival> Intake::arrival(Arrival::Kind kind) const {
  auto arrival = std::make_shared<Arrival>();
  arrival->kind = kind;
  arrival->input = input_;
  arrival->input_name = arguments_.inputs[input_];
  arrival->number = records_;
  arrival->bytes = bytes_before_ + (reader_ ? reader_->bytes_read() : 0);
  return arrival;
}

std::shared_ptr<Arrival> Intake::open() {
  const std::string& input = arguments_.inputs[input_];
  ReadOptions options = arguments_.read_options(input);
  options.wants_sha256 = !arguments_.status_stem.empty();
  reader_ = std::make_unique<Reader>(input, options);
  records_ = 0;
  is_first_ = is_readable_ = true;
  return arrival(Arrival::Kind::begin);
}

std::shared_ptr<Arrival> Intake::read() {
  auto here = arrival(Arrival::Kind::record);
  auto record = here->timings.measure(Stage::read, [&] { return reader_->next(); });
  if (!record) {
    const std::string sha256 = reader_->sha256();
    auto end = finish(Arrival::Kind::end);
    end->is_whole = is_readable_;
    end->sha256 = sha256;
    return end;
  }
  here->number = ++records_;
  here->bytes = bytes_before_ + reader_->bytes_read();
  here->was_done = is_before_start();
  if (arguments_.is_resumable) here->sha256 = reader_->sha256();
  const bool is_stream = reader_->format() == Format::cityjson_seq;
  if (is_stream) here->line = reader_->line();
  // A line of a stream costs that line; a file as a whole, or a stream's header, costs the input.
  here->is_one_of_many = is_stream && !is_first_;
  if (!record->value && !here->is_one_of_many) is_readable_ = false;
  if (!record->value && is_stream) here->refused = reader_->refused_line();
  here->is_header = is_first_ && reader_->format() != Format::cityjson;
  is_first_ = false;
  here->record = std::move(*record);
  if (!arguments_.reuse.empty() && is_stream && here->record.value) {
    if (here->is_header)
      header_sha256_ = sha256(source_line(*here->record.value));
    else
      here->header_sha256 = header_sha256_;
  }
  return here;
}

std::shared_ptr<Arrival> Intake::finish(Arrival::Kind kind) {
  auto last = arrival(kind);
  ++input_;
  records_ = 0;
  bytes_before_ = last->bytes;
  reader_.reset();
  return last;
}

}  // namespace oriel::cli
