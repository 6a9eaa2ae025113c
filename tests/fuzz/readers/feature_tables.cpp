#include "io/records/feature_tables.h"

#include "interpret/labelling/interpret.h"
#include "io/records/feature_records.h"
#include "tests/fuzz/support/pack.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

namespace {

/// What was read is written in another form and read again: it is the same.
void check_emitted(const std::vector<FeatureRecord>& records) {
  static const ScratchFile file("again.jsonl");
  const std::string text = FeatureRecordWriter::text(RecordFormat::jsonl, records);
  const auto again = read_feature_records(file.write(text));
  promise(again.value && again.issues.empty(), "records that were written can be read",
          again.issues.empty() ? "" : to_string(again.issues.front()));
  promise(FeatureRecordWriter::text(RecordFormat::jsonl, *again.value) == text,
          "records that were read again are written as the same bytes");
}

}  // namespace

/// As the text begins: an array of records, one record a line, or CSV.
void feature_tables(std::string_view bytes) {
  static const ScratchFile csv("a.csv"), json("a.json"), lines("a.jsonl");
  const ScratchFile& file = bytes.starts_with('[') ? json : bytes.starts_with('{') ? lines : csv;
  try {
    const auto records = read_feature_records(file.write(bytes));
    promise(records.value || has_errors(records.issues), "a table has a value or an error");
    if (records.value) check_emitted(*records.value);
    const auto tables = read_feature_tables(file.path());
    if (!tables.value) return;
    for (const DescribedBuilding& building : *tables.value)
      promise(interpret(default_pack(), building.table, building.graph).verdicts.size() ==
                  building.table.rows(),
              "each feature has a verdict");
  } catch (const InputError& error) {
    (void)to_string(error.issue());
  }
}

}  // namespace oriel::fuzz
