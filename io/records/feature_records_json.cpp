#include "io/json/json_check.h"
#include "io/records/record_text.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

using oriel::append_json;

void append_json(std::string& out, const std::optional<double>& number) {
  append_json(out, number.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void append_json(std::string& out, const RecordValue& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    return append_json(out, std::string_view(*text));
  const auto* number = std::get_if<double>(&value);
  append_json(out, number == nullptr ? std::nullopt : std::optional(*number));
}

/// The CSV form of a value; nothing for an object.
std::optional<std::string> cell_of(const nlohmann::json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number()) return value.dump();
  if (!value.is_array()) return std::nullopt;
  std::string cell;
  for (const nlohmann::json& element : value) {
    if (element.is_structured()) return std::nullopt;
    if (&element != &value.front()) cell += ';';
    cell += *cell_of(element);
  }
  return cell;
}

/// Gives one record away; says what is wrong with it.
std::optional<std::string> take_object(const nlohmann::json& object, const RecordTaker& take,
                                       RecordColumns& columns) {
  if (!object.is_object())
    return fmt::format("a record is {}; expected an object", object.type_name());
  const auto& fields = record_fields();
  std::vector<std::string> values(fields.size());
  RecordColumns found(fields.size());
  for (const auto& [key, value] : object.items()) {
    const auto field = static_cast<std::size_t>(std::ranges::find(fields, key) - fields.begin());
    if (field == fields.size()) continue;
    found[field] = true;
    auto cell = cell_of(value);
    if (!cell) return fmt::format("'{}' holds an object or nested arrays", key);
    values[field] = std::move(*cell);
  }
  if (values[record_field::building].empty() || values[record_field::id].empty())
    return "'building' or 'id' is missing";
  columns = common_columns(columns, found);
  return take(RecordCells(values.begin(), values.end()));
}

void take_record(const nlohmann::json& object, const TextName& name, const std::string& prefix,
                 const RecordTaker& take, std::vector<Issue>& issues, RecordColumns& columns) {
  if (const auto fault = take_object(object, take, columns))
    issues.push_back(error_in(name, {Code::E111, prefix + *fault}));
}

}  // namespace

void append_json_record(std::string& out, const FeatureRecord& record,
                        const RecordColumns& columns) {
  const auto& fields = record_fields();
  std::size_t field = 0;
  /// False for a field that is not wanted.
  const auto key = [&] {
    const std::size_t at = field++;
    if (has_column(columns, at)) append_json_key(out, fields[at]);
    return has_column(columns, at);
  };
  const auto text = [&](const std::string& value) {
    if (key()) append_json(out, std::string_view(value));
  };
  const auto number = [&](const std::optional<double>& value) {
    if (key()) append_json(out, value);
  };
  const auto list = [&](const auto& values) {
    if (key()) append_json_array(out, values);
  };
  out += '{';
  text(record.building);
  text(record.id);
  text(record.name);
  text(record.label);
  number(record.score);
  number(record.margin);
  text(record.rule);
  text(record.runner_up);
  text(record.parent);
  text(record.host);
  list(record.aabb_m);
  list(record.source_polygons);
  for (const RecordValue& value : record.attributes)
    if (key()) append_json(out, value);
  for (const auto& ids : record.relations) list(ids);
  list(record.groups);
  text(record.part_of);
  text(record.corrected_by);
  text(record.corrected_why);
  out += '}';
}

bool visit_json_records(std::string_view text, const TextName& name, bool is_lines,
                        const RecordTaker& take, std::vector<Issue>& issues,
                        RecordColumns& columns) {
  columns.clear();
  if (!is_lines) {
    const auto root = parse_slowly(name, text, issues);
    if (!root) return false;
    if (!root->is_array()) {
      issues.push_back(
          error_in(name, {Code::E111, fmt::format("the file holds one {}; expected an array of "
                                                  "records, as label --features writes them",
                                                  root->type_name())}));
      return false;
    }
    for (std::size_t i = 0; i < root->size(); ++i)
      take_record((*root)[i], name, fmt::format("record {}: ", i), take, issues, columns);
    return true;
  }
  for_each_line(text, [&](std::string_view record, int number) {
    const TextName line{name.file, number};
    if (const auto object = parse_slowly(line, record, issues))
      take_record(*object, line, "", take, issues, columns);
  });
  return true;
}

}  // namespace oriel::detail
