#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Which fields a table of records has: by position in record_fields(). Empty: all of them.
using RecordColumns = std::vector<bool>;

/// True if the field at that position of record_fields() is one of the columns.
inline bool has_column(const RecordColumns& columns, std::size_t field) {
  return columns.empty() || columns[field];
}

/// Those with these names, and building and id, which every table has. Names that are none of
/// record_fields() are passed over.
RecordColumns columns_named(const std::vector<std::string>& names);

/// The names of the columns, in the order of record_fields().
std::vector<std::string> names_of_columns(const RecordColumns& columns);

/// Those that both have.
RecordColumns common_columns(const RecordColumns& some, const RecordColumns& others);

/// True if a feature can be named from them (set_names).
bool has_columns_of_names(const RecordColumns& columns);

}  // namespace oriel
