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

std::shared_ptr<Arrival> Intake::open() {
  reader_ = std::make_unique<Reader>(arguments_.inputs[input_], arguments_.read_options());
  is_first_ = is_readable_ = true;
  auto begin = std::make_shared<Arrival>();
  begin->input = input_;
  return begin;
}

std::shared_ptr<Arrival> Intake::read() {
  auto arrival = std::make_shared<Arrival>();
  arrival->kind = Arrival::Kind::record;
  arrival->input = input_;
  auto record = arrival->timings.measure(Stage::read, [&] { return reader_->next(); });
  if (!record) {
    auto end = finish(Arrival::Kind::end);
    end->is_whole = is_readable_;
    return end;
  }
  // A line of a stream costs that line; a file as a whole, or a stream's header, costs the input.
  arrival->is_one_of_many = reader_->format() == Format::cityjson_seq && !is_first_;
  if (!record->value && !arrival->is_one_of_many) is_readable_ = false;
  is_first_ = false;
  arrival->record = std::move(*record);
  return arrival;
}

std::shared_ptr<Arrival> Intake::finish(Arrival::Kind kind) {
  auto arrival = std::make_shared<Arrival>();
  arrival->kind = kind;
  arrival->input = input_++;
  reader_.reset();
  return arrival;
}

}  // namespace oriel::cli
