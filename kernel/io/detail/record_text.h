#pragma once

#include "kernel/io/detail/text.h"
#include "kernel/io/feature_records.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// Appends the line of a CSV: `cells` quoted where they must be.
void append_csv_line(std::string& out, const std::vector<std::string>& cells);
/// Appends the record as a line of CSV, or as a JSON object without line end.
void append_csv_record(std::string& out, const FeatureRecord& record);
void append_json_record(std::string& out, const FeatureRecord& record);

/// Sets the field of that name (see record_fields) from its CSV form. Says what is wrong with it;
/// unknown fields are passed over.
std::optional<std::string> set_field(FeatureRecord& record, std::string_view field,
                                     const std::string& cell);

/// A record in which every value is missing.
FeatureRecord empty_record();

Checked<std::vector<FeatureRecord>> read_csv_records(std::string_view text, const TextName& name);
/// An array of records, or with `is_lines` one object a line.
Checked<std::vector<FeatureRecord>> read_json_records(std::string_view text, const TextName& name,
                                                      bool is_lines);

}  // namespace oriel::detail
