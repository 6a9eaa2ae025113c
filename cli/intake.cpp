#include "cli/intake.h"

#include "kernel/model/issue.h"

#include <utility>

namespace oriel::cli {

std::shared_ptr<Arrival> Intake::next() {
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
  return arrival;
}

std::shared_ptr<Arrival> Intake::open() {
  const std::string& input = arguments_.inputs[input_];
  reader_ = std::make_unique<Reader>(input, arguments_.read_options(input));
  is_first_ = is_readable_ = true;
  return arrival(Arrival::Kind::begin);
}

std::shared_ptr<Arrival> Intake::read() {
  auto here = arrival(Arrival::Kind::record);
  auto record = here->timings.measure(Stage::read, [&] { return reader_->next(); });
  if (!record) {
    auto end = finish(Arrival::Kind::end);
    end->is_whole = is_readable_;
    return end;
  }
  const bool is_stream = reader_->format() == Format::cityjson_seq;
  if (is_stream) here->line = reader_->line();
  // A line of a stream costs that line; a file as a whole, or a stream's header, costs the input.
  here->is_one_of_many = is_stream && !is_first_;
  if (!record->value && !here->is_one_of_many) is_readable_ = false;
  if (!record->value && is_stream) here->refused = reader_->refused_line();
  here->is_header = is_first_ && reader_->format() != Format::cityjson;
  is_first_ = false;
  here->record = std::move(*record);
  return here;
}

std::shared_ptr<Arrival> Intake::finish(Arrival::Kind kind) {
  auto last = arrival(kind);
  ++input_;
  reader_.reset();
  return last;
}

}  // namespace oriel::cli
