#include "io/gpkg/gpkg_columns.h"

#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

ColumnType cell_type(const GpkgValue& value) { return static_cast<ColumnType>(value.index()); }

bool is_numeric(ColumnType type) { return type == ColumnType::integer || type == ColumnType::real; }

void take_in(GpkgColumn& column, ColumnType type) {
  if (type == ColumnType::none || type == column.type) return;
  if (column.type == ColumnType::none) {
    column.type = type;
  } else if (is_numeric(column.type) && is_numeric(type)) {
    column.type = ColumnType::real;
  } else {
    column.type = ColumnType::text;
    column.is_mixed = true;
  }
}

std::string cell_text(const GpkgValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&value)) return shortest(*number);
  return {};
}

/// In SQLite a text ends at its first NUL for most who read it.
std::string without_nul(std::string text) {
  for (std::size_t at = text.find('\0'); at != std::string::npos; at = text.find('\0', at))
    text.replace(at, 1, "\xEF\xBF\xBD");
  return text;
}

GpkgValue as_type(const GpkgValue& value, ColumnType type) {
  if (std::holds_alternative<std::monostate>(value)) return {};
  if (type == ColumnType::text) return without_nul(cell_text(value));
  if (const auto* whole = std::get_if<std::int64_t>(&value); whole && type == ColumnType::real)
    return static_cast<double>(*whole);
  return value;
}

std::string lower_case(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// A name that a column can have: without control characters, not empty, not endless.
std::string usable(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  std::string result = name.substr(0, kLongest);
  // No half of a character at the end.
  while (result.size() < name.size() && !result.empty() &&
         (static_cast<unsigned char>(name[result.size()]) & 0xC0U) == 0x80U)
    result.pop_back();
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) c = '_';
  return result.empty() ? "attribute" : result;
}

void append_member(std::string& json, const std::string& name, const GpkgValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    append_field(json, name, std::string_view(*text));
  else if (const auto* truth = std::get_if<bool>(&value))
    append_field(json, name, *truth);
  else if (const auto* whole = std::get_if<std::int64_t>(&value))
    append_field(json, name, *whole);
  else if (const auto* number = std::get_if<double>(&value))
    append_field(json, name, *number);
}

}  // namespace

void GpkgColumns::declare(std::string name, ColumnType type, GpkgRole role) {
  if (place_of_.try_emplace({role, name}, columns_.size()).second)
    columns_.push_back({std::move(name), role, type});
}

void GpkgColumns::note(const GpkgRow& row) {
  ++rows_;
  if (!row.geometry.empty()) box_.grow(row.box);
  for (const GpkgCell& cell : row.cells) {
    const auto [found, is_new] = place_of_.try_emplace({cell.role, cell.column}, columns_.size());
    if (is_new) columns_.push_back({cell.column, cell.role});
    take_in(columns_[found->second], cell_type(cell.value));
  }
}

void GpkgColumns::settle() {
  std::ranges::stable_sort(columns_, [](const GpkgColumn& one, const GpkgColumn& other) {
    const auto rank = [](GpkgRole role) { return role == GpkgRole::row ? GpkgRole::fixed : role; };
    return rank(one.role) < rank(other.role);
  });
  has_rest_ = columns_.size() > kMost;
  if (has_rest_) columns_.resize(kMost);
  std::set<std::string> taken{"fid", "geom", "geometry", kRestColumn};  // "geometry": of GeoPandas
  place_of_.clear();
  for (GpkgColumn& column : columns_) {
    place_of_.try_emplace({column.role, column.name}, place_of_.size());
    const std::string name = usable(column.name);
    column.table_name = name;
    for (int number = 2; !taken.insert(lower_case(column.table_name)).second; ++number)
      column.table_name = name + '_' + std::to_string(number);
  }
}

std::vector<GpkgValue> GpkgColumns::values(const GpkgRow& row, std::int64_t number) const {
  std::vector<GpkgValue> values(columns_.size() + (has_rest_ ? 1 : 0));
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].role == GpkgRole::count) values[i] = std::int64_t{0};
  std::string rest = "{";
  for (const GpkgCell& cell : row.cells) {
    const auto found = place_of_.find({cell.role, cell.column});
    if (found == place_of_.end())
      append_member(rest, cell.column, cell.value);
    else if (const auto* other = std::get_if<std::int64_t>(&cell.value);
             other != nullptr && cell.role == GpkgRole::row)
      values[found->second] = number + *other;
    else
      values[found->second] = as_type(cell.value, columns_[found->second].type);
  }
  if (rest.size() > 1) values.back() = rest + '}';
  return values;
}

std::string type_name(ColumnType type) {
  switch (type) {
    case ColumnType::boolean:
      return "BOOLEAN";
    case ColumnType::integer:
      return "INTEGER";
    case ColumnType::real:
      return "REAL";
    default:
      return "TEXT";
  }
}

}  // namespace oriel::detail
