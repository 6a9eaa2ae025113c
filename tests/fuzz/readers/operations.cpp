#include "generalise/series/scale_series.h"
#include "io/records/operation_log.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

#include <algorithm>
#include <string>

namespace oriel::fuzz {

namespace {

std::string text_of(const std::vector<SeriesOperation>& operations) {
  std::string text;
  for (const SeriesOperation& operation : operations) text += operation_line(operation);
  return text;
}

/// A log carried out from nothing and undone again. The first scale at which something happens is
/// above `from`.
void carry_out(const std::vector<SeriesOperation>& operations) {
  constexpr double kFinest = 0, kCoarsest = 1e9;
  LevelState state;
  if (!move_state(state, operations, kFinest, kCoarsest)) return;
  (void)labelled_building(state, {});
  (void)move_state(state, operations, kCoarsest, kFinest);
}

/// OperationReader says the same of a file.
void read_one_by_one(std::string_view bytes, const std::vector<SeriesOperation>& operations) {
  static const ScratchFile file("a.oplog.jsonl");
  OperationReader reader(file.write(bytes));
  std::string text;
  while (reader.next() != nullptr) text += operation_line(reader.take());
  promise(text == text_of(operations), "operations one by one are those of the whole text");
}

}  // namespace

/// The log of a series.
void operations(std::string_view bytes) {
  const auto operations = read_operations(bytes, "a.oplog.jsonl");
  promise(operations.value || has_errors(operations.issues), "a log has a value or an error");
  if (!operations.value) return;
  const std::string text = text_of(*operations.value);
  const auto again = read_operations(text, "again.oplog.jsonl");
  promise(again.value.has_value(), "a log that was written can be read",
          again.issues.empty() ? "" : to_string(again.issues.front()));
  promise(text_of(*again.value) == text, "a log that was read again is written as the same bytes");
  carry_out(*operations.value);
  read_one_by_one(bytes, *operations.value);
}

}  // namespace oriel::fuzz
