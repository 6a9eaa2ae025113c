#include "kernel/io/feature_records.h"

#include "kernel/io/detail/input.h"
#include "kernel/io/detail/json_text.h"
#include "kernel/io/detail/record_text.h"
#include "kernel/io/detail/words.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

const std::vector<RelationKind>& relations() {
  static const std::vector<RelationKind> without_host = [] {
    std::vector<RelationKind> all = relation_schema();
    std::erase_if(all, [](const RelationKind& relation) { return relation.name == "host"; });
    return all;
  }();
  return without_host;
}

std::string id_of(const FeatureTable& table, FeatureId feature) {
  return feature.is_valid() ? table.id(feature) : "";
}

std::vector<RecordValue> attributes_of(const FeatureTable& table, FeatureId row) {
  std::vector<RecordValue> values;
  for (std::size_t c = 0; c < feature_schema().size(); ++c) {
    values.emplace_back();
    if (feature_schema()[c].unit == Unit::text) {
      const std::string& text = table.texts(c)[row.index()];
      if (!text.empty()) values.back() = text;
    } else if (const auto number = table.number(row, c)) {
      values.back() = *number;
    }
  }
  return values;
}

RecordFormat format_to_use(const std::string& path) {
  const auto format = record_format_of(path);
  if (format) return *format;
  throw InputError(detail::error_in(
      {path, 0}, {"E106",
                  "the format of the feature records is unknown; expected a name in .csv, .json or "
                  ".jsonl"}));
}

/// The parts of a list joined by ';'.
std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(';'), list.size());
    parts.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return parts;
}

std::string no_number(std::string_view field, std::string_view cell) {
  return fmt::format("'{}' is {}; expected a number", field, detail::in_quotes(cell));
}

std::optional<std::string> set_number(std::optional<double>& value, std::string_view field,
                                      const std::string& cell) {
  if (cell.empty()) return std::nullopt;
  value = detail::as_double(cell);
  if (!value) return no_number(field, cell);
  return std::nullopt;
}

std::optional<std::string> set_box(FeatureRecord& record, const std::string& cell) {
  if (cell.empty()) return std::nullopt;
  const std::vector<std::string> parts = split(cell);
  for (std::size_t i = 0; i < record.aabb_m.size(); ++i) {
    const auto number = i < parts.size() ? detail::as_double(parts[i]) : std::nullopt;
    if (!number || parts.size() != record.aabb_m.size())
      return fmt::format("'aabb_m' is {}; expected six numbers", detail::in_quotes(cell));
    record.aabb_m[i] = *number;
  }
  return std::nullopt;
}

std::optional<std::string> set_polygons(FeatureRecord& record, const std::string& cell) {
  record.source_polygons.clear();
  for (const std::string& part : split(cell)) {
    const auto number = detail::as_whole(part);
    if (!number || *number < 0 || *number > std::numeric_limits<int>::max())
      return fmt::format("'source_polygons' holds {}; expected whole numbers",
                         detail::in_quotes(part));
    record.source_polygons.push_back(static_cast<int>(*number));
  }
  return std::nullopt;
}

std::optional<std::string> set_attribute(RecordValue& value, const Attribute& attribute,
                                         const std::string& cell) {
  value = std::monostate();
  if (cell.empty()) return std::nullopt;
  if (attribute.unit == Unit::text) {
    value = cell;
    return std::nullopt;
  }
  const auto number = detail::as_double(cell);
  if (!number) return no_number(record_name(attribute), cell);
  value = *number;
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& record_fields() {
  static const std::vector<std::string> fields = [] {
    std::vector<std::string> names{"building", "id",     "label",          "score",
                                   "margin",   "rule",   "runner_up",      "parent",
                                   "host",     "aabb_m", "source_polygons"};
    for (const Attribute& attribute : feature_schema()) names.push_back(record_name(attribute));
    for (const RelationKind& relation : relations()) names.push_back("rel_" + relation.name);
    names.emplace_back("groups");
    return names;
  }();
  return fields;
}

std::vector<FeatureRecord> feature_records(const Building& building,
                                           const Segmentation& segmentation,
                                           const FeatureTable& table, const FeatureGraph& graph,
                                           const Interpretation* interpretation) {
  std::vector<FeatureRecord> records;
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    const Feature& feature = segmentation.features[i];
    const FeatureId row{static_cast<int>(i)};
    FeatureRecord record;
    record.building = building.id;
    record.id = table.id(row);
    record.parent = id_of(table, feature.parent);
    record.host = id_of(table, feature.host);
    const Box box = feature.box.moved(building.frame.origin_m);
    record.aabb_m = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
    record.source_polygons = feature.source_polygons;
    record.attributes = attributes_of(table, row);
    for (const RelationKind& relation : relations()) {
      record.relations.emplace_back();
      for (const auto& [self, other] : graph.of(relation.name, row))
        record.relations.back().push_back(table.id(other));
    }
    records.push_back(std::move(record));
  }
  if (interpretation == nullptr) return records;
  for (const Verdict& verdict : interpretation->verdicts) {
    FeatureRecord& record = records.at(verdict.feature.index());
    record.label = verdict.label;
    record.score = verdict.score;
    record.margin = verdict.margin;
    record.rule = verdict.rule;
    record.runner_up = verdict.runner_up;
    record.groups = verdict.groups;
  }
  return records;
}

std::optional<RecordFormat> record_format_of(std::string_view path) {
  if (path.ends_with(".csv")) return RecordFormat::csv;
  if (path.ends_with(".json")) return RecordFormat::json;
  if (path.ends_with(".jsonl")) return RecordFormat::jsonl;
  return std::nullopt;
}

FeatureRecordWriter::FeatureRecordWriter(const std::string& path)
    : format_(format_to_use(path)), file_(path) {
  is_empty_ = file_.size() <= 1;
  if (file_.size() > 0) return;  // it goes on
  std::string head = format_ == RecordFormat::json ? "[" : "";
  if (format_ == RecordFormat::csv) detail::append_csv_line(head, record_fields());
  file_.append(head);
}

void FeatureRecordWriter::append(const std::vector<FeatureRecord>& records) {
  std::string text;
  for (const FeatureRecord& record : records) {
    if (format_ == RecordFormat::csv) {
      detail::append_csv_record(text, record);
      continue;
    }
    if (format_ == RecordFormat::json) text += std::exchange(is_empty_, false) ? "\n" : ",\n";
    detail::append_json_record(text, record);
    if (format_ == RecordFormat::jsonl) text += '\n';
  }
  file_.append(text);
}

void FeatureRecordWriter::commit() {
  if (format_ == RecordFormat::json) file_.append(is_empty_ ? "]\n" : "\n]\n");
  file_.commit();
}

Checked<std::vector<FeatureRecord>> read_feature_records(const std::string& path) {
  const RecordFormat format = format_to_use(path);
  const std::string text = detail::Input(path).read_all();
  const std::string_view bare = detail::without_bom(text);
  if (format == RecordFormat::csv) return detail::read_csv_records(bare, {path, 0});
  return detail::read_json_records(bare, {path, 0}, format == RecordFormat::jsonl);
}

namespace detail {

FeatureRecord empty_record() {
  FeatureRecord record;
  record.attributes.resize(feature_schema().size());
  record.relations.resize(relations().size());
  return record;
}

std::optional<std::string> set_field(FeatureRecord& record, std::string_view field,
                                     const std::string& cell) {
  using Text = std::pair<std::string_view, std::string FeatureRecord::*>;
  static constexpr std::array<Text, 7> kTexts{{{"building", &FeatureRecord::building},
                                               {"id", &FeatureRecord::id},
                                               {"label", &FeatureRecord::label},
                                               {"rule", &FeatureRecord::rule},
                                               {"runner_up", &FeatureRecord::runner_up},
                                               {"parent", &FeatureRecord::parent},
                                               {"host", &FeatureRecord::host}}};
  for (const auto& [name, text] : kTexts)
    if (name == field) record.*text = cell;
  if (field == "score") return set_number(record.score, field, cell);
  if (field == "margin") return set_number(record.margin, field, cell);
  if (field == "aabb_m") return set_box(record, cell);
  if (field == "source_polygons") return set_polygons(record, cell);
  if (field == "groups") record.groups = split(cell);
  for (std::size_t c = 0; c < feature_schema().size(); ++c)
    if (record_name(feature_schema()[c]) == field)
      return set_attribute(record.attributes[c], feature_schema()[c], cell);
  for (std::size_t r = 0; r < relations().size(); ++r)
    if (field == "rel_" + relations()[r].name) record.relations[r] = split(cell);
  return std::nullopt;
}

}  // namespace detail

}  // namespace oriel
