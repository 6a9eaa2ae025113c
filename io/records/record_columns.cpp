#include "io/records/record_columns.h"

#include "io/records/feature_records.h"
#include "io/records/record_text.h"

#include <algorithm>

namespace oriel {

RecordColumns columns_named(const std::vector<std::string>& names) {
  const auto& fields = record_fields();
  RecordColumns columns(fields.size());
  columns[detail::record_field::building] = columns[detail::record_field::id] = true;
  for (const std::string& name : names)
    if (const auto found = std::ranges::find(fields, name); found != fields.end())
      columns[static_cast<std::size_t>(found - fields.begin())] = true;
  return columns;
}

std::vector<std::string> names_of_columns(const RecordColumns& columns) {
  std::vector<std::string> names;
  for (std::size_t field = 0; field < record_fields().size(); ++field)
    if (has_column(columns, field)) names.push_back(record_fields()[field]);
  return names;
}

RecordColumns common_columns(const RecordColumns& some, const RecordColumns& others) {
  if (some.empty() || others.empty()) return some.empty() ? others : some;
  RecordColumns common(some.size());
  for (std::size_t field = 0; field < some.size(); ++field)
    common[field] = some[field] && others[field];
  return common;
}

bool has_columns_of_names(const RecordColumns& columns) {
  const RecordColumns needed = columns_named(
      {"host", "aabb_m", record_name(info_of(Attribute::host_inclination)),
       record_name(info_of(Attribute::azimuth)), record_name(info_of(Attribute::storey))});
  return common_columns(columns, needed) == needed;
}

}  // namespace oriel
