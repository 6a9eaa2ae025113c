#include "io/records/feature_records.h"

#include "io/files/input.h"
#include "io/json/words.h"
#include "io/records/record_text.h"
#include "kernel/base/text/json_text.h"
#include "model/description/feature_names.h"

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string id_of(const FeatureTable& table, FeatureId feature) {
  return feature.is_valid() ? table.id(feature) : "";
}

std::vector<RecordValue> attributes_of(const FeatureTable& table, FeatureId row) {
  std::vector<RecordValue> values;
  for (const Attribute attribute : kAttributes) {
    values.emplace_back();
    if (info_of(attribute).unit == Unit::text) {
      const std::string& text = table.text(row, attribute);
      if (!text.empty()) values.back() = text;
    } else if (const auto number = table.number(row, attribute)) {
      values.back() = *number;
    }
  }
  return values;
}

RecordFormat format_to_use(const std::string& path) {
  const auto format = record_format_of(path);
  if (format) return *format;
  throw InputError(error_in(
      {path, 0}, {Code::E106,
                  "the format of the feature records is unknown; expected a name in .csv, .json or "
                  ".jsonl"}));
}

std::vector<std::string> split(std::string_view list) {
  std::vector<std::string> parts;
  detail::for_each_part(list, [&](std::string_view part) { parts.emplace_back(part); });
  return parts;
}

std::optional<std::string> set_number(std::optional<double>& value, std::size_t field,
                                      std::string_view cell) {
  if (cell.empty()) return std::nullopt;
  value = detail::as_double(cell);
  if (!value) return detail::no_number(record_fields()[field], cell);
  return std::nullopt;
}

std::optional<std::string> set_polygons(FeatureRecord& record, std::string_view cell) {
  for (const std::string& part : split(cell)) {
    const auto number = detail::as_whole(part);
    if (!number || *number < 0 || *number > std::numeric_limits<int>::max())
      return fmt::format("'source_polygons' holds {}; expected whole numbers", in_quotes(part));
    record.source_polygons.push_back(static_cast<int>(*number));
  }
  return std::nullopt;
}

std::optional<std::string> add_attribute(FeatureRecord& record, const AttributeInfo& attribute,
                                         std::string_view cell) {
  RecordValue& value = record.attributes.emplace_back();
  if (cell.empty()) return std::nullopt;
  if (attribute.unit == Unit::text) {
    value = std::string(cell);
    return std::nullopt;
  }
  const auto number = detail::as_double(cell);
  if (!number) return detail::no_number(record_name(attribute), cell);
  value = *number;
  return std::nullopt;
}

/// Relations that part the features of a building into classes, or nearly so.
bool may_be_of_classes(std::string_view relation) {
  return relation == "same_facade" || relation == "same_storey" || relation == "alike";
}

/// The class of each feature, those of one feature left out and the others numbered anew, by their
/// first features.
std::vector<std::optional<detail::RelationClass>> relation_classes(
    const std::vector<int>& class_of_row) {
  std::map<int, int> sizes, numbers;
  for (const int number : class_of_row) ++sizes[number];
  int count = 0;
  std::vector<std::optional<detail::RelationClass>> classes;
  for (const int number : class_of_row) {
    classes.emplace_back();
    if (number < 0 || sizes[number] < 2) continue;
    const auto [place, is_new] = numbers.try_emplace(number, count + 1);
    if (is_new) ++count;
    classes.back() = {place->second, sizes[number]};
  }
  return classes;
}

/// By row, -1: none; nothing if features do not fall into classes by the relation.
std::optional<std::vector<int>> classes_by(const FeatureLinks& links, std::string_view relation) {
  if (!may_be_of_classes(relation)) return std::nullopt;
  return links.are_classes ? std::optional(links.list_of) : classes_of(links);
}

/// Adds what each feature is related to.
void add_relation(const FeatureTable& table, const FeatureGraph& graph, const std::string& relation,
                  std::vector<FeatureRecord>& records) {
  const auto class_of_row = classes_by(graph.links(relation), relation);
  const auto classes = class_of_row ? relation_classes(*class_of_row)
                                    : std::vector<std::optional<detail::RelationClass>>();
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::vector<std::string>& related = records[i].relations.emplace_back();
    if (i < classes.size() && classes[i]) related.push_back(to_string(*classes[i]));
    if (class_of_row) continue;
    for (const FeatureId other : graph.others(relation, FeatureId{static_cast<int>(i)}))
      related.push_back(table.id(other));
  }
}

void set_verdicts(std::vector<FeatureRecord>& records, const Segmentation& segmentation,
                  const FeatureTable& table, const Interpretation& interpretation) {
  auto groups = groups_by_feature(interpretation);
  std::vector<FeatureId> hosts;
  for (const Feature& feature : segmentation.features) hosts.push_back(feature.host);
  const std::vector<FeatureId> wholes = wholes_by_feature(interpretation, hosts);
  for (const Verdict& verdict : interpretation.verdicts) {
    const std::size_t row = verdict.feature.index();
    set_verdict(records.at(row), verdict, std::move(groups.at(row)), id_of(table, wholes.at(row)));
  }
}

std::optional<std::string> fill(FeatureRecord& record, const detail::RecordCells& cells) {
  namespace field = detail::record_field;
  record.building = cells[field::building];
  record.id = cells[field::id];
  record.name = cells[field::name];
  record.label = cells[field::label];
  record.rule = cells[field::rule];
  record.runner_up = cells[field::runner_up];
  record.parent = cells[field::parent];
  record.host = cells[field::host];
  if (auto fault = set_number(record.score, field::score, cells[field::score])) return fault;
  if (auto fault = set_number(record.margin, field::margin, cells[field::margin])) return fault;
  if (auto fault = detail::read_box(cells[field::aabb_m], record.aabb_m)) return fault;
  if (auto fault = set_polygons(record, cells[field::source_polygons])) return fault;
  std::size_t at = field::first_attribute;
  for (const AttributeInfo& attribute : feature_schema())
    if (auto fault = add_attribute(record, attribute, cells[at++])) return fault;
  for (std::size_t r = 0; r < detail::recorded_relations().size(); ++r)
    record.relations.push_back(split(cells[at++]));
  record.groups = split(cells[at++]);
  record.part_of = cells[at++];
  record.corrected_by = cells[at++];
  record.corrected_why = cells[at];
  return std::nullopt;
}

}  // namespace

const std::vector<std::string>& record_fields() {
  static const std::vector<std::string> fields = [] {
    std::vector<std::string> names{"building", "id",     "name",   "label",
                                   "score",    "margin", "rule",   "runner_up",
                                   "parent",   "host",   "aabb_m", "source_polygons"};
    for (const AttributeInfo& attribute : feature_schema()) names.push_back(record_name(attribute));
    for (const RelationKind& relation : detail::recorded_relations())
      names.push_back("rel_" + relation.name);
    names.emplace_back("groups");
    names.emplace_back("part_of");
    names.emplace_back("corrected_by");
    names.emplace_back("corrected_why");
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
    records.push_back(std::move(record));
  }
  set_relations(records, table, graph);
  if (interpretation != nullptr) set_verdicts(records, segmentation, table, *interpretation);
  set_names(records);
  return records;
}

void set_relations(std::vector<FeatureRecord>& records, const FeatureTable& table,
                   const FeatureGraph& graph) {
  for (FeatureRecord& record : records) record.relations.clear();
  for (const RelationKind& relation : detail::recorded_relations())
    add_relation(table, graph, relation.name, records);
}

void set_names(std::span<FeatureRecord> records) {
  std::unordered_map<std::string_view, int> rows;
  for (std::size_t i = 0; i < records.size(); ++i) rows.emplace(records[i].id, static_cast<int>(i));
  std::vector<NameParts> features;
  for (const FeatureRecord& record : records) {
    const auto number = [&](Attribute attribute) -> std::optional<double> {
      const double* value = std::get_if<double>(&record.attributes.at(column_of(attribute)));
      return value != nullptr ? std::optional(*value) : std::nullopt;
    };
    const auto host = rows.find(record.host);
    const auto& box = record.aabb_m;
    features.push_back({record.id, record.label,
                        host == rows.end() ? FeatureId{} : FeatureId{host->second},
                        number(Attribute::host_inclination), number(Attribute::azimuth),
                        number(Attribute::storey).has_value(),
                        Box{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}}});
  }
  std::vector<std::string> names = feature_names(features);
  for (std::size_t i = 0; i < records.size(); ++i) records[i].name = std::move(names[i]);
}
void set_verdict(FeatureRecord& record, const Verdict& verdict, std::vector<std::string> groups,
                 std::string part_of) {
  record.label = verdict.label;
  record.score = verdict.score;
  record.margin = verdict.margin;
  record.rule = verdict.rule;
  record.runner_up = verdict.runner_up;
  record.groups = std::move(groups);
  record.part_of = std::move(part_of);
  record.corrected_by.clear();
  record.corrected_why.clear();
}

std::optional<RecordFormat> record_format_of(std::string_view path) {
  if (path.ends_with(".csv")) return RecordFormat::csv;
  if (path.ends_with(".json")) return RecordFormat::json;
  if (path.ends_with(".jsonl")) return RecordFormat::jsonl;
  return std::nullopt;
}

FeatureRecordWriter::FeatureRecordWriter(const std::string& path, const RecordColumns& columns)
    : format_(format_to_use(path)), columns_(columns), file_(path) {
  is_empty_ = file_.size() <= 1;
  if (file_.size() > 0) return;  // it goes on
  std::string head = format_ == RecordFormat::json ? "[" : "";
  if (format_ == RecordFormat::csv) append_csv_line(head, names_of_columns(columns_));
  file_.append(head);
}

std::string FeatureRecordWriter::text(RecordFormat format,
                                      const std::vector<FeatureRecord>& records,
                                      const RecordColumns& columns) {
  std::string text;
  for (const FeatureRecord& record : records) {
    if (format == RecordFormat::csv) {
      detail::append_csv_record(text, record, columns);
      continue;
    }
    if (format == RecordFormat::json && !text.empty()) text += ",\n";
    detail::append_json_record(text, record, columns);
    if (format == RecordFormat::jsonl) text += '\n';
  }
  return text;
}

void FeatureRecordWriter::append(std::string_view text) {
  if (text.empty()) return;
  if (format_ == RecordFormat::json) file_.append(std::exchange(is_empty_, false) ? "\n" : ",\n");
  file_.append(text);
}

void FeatureRecordWriter::append(const std::vector<FeatureRecord>& records) {
  append(text(format_, records, columns_));
}

void FeatureRecordWriter::commit() {
  if (format_ == RecordFormat::json) file_.append(is_empty_ ? "]\n" : "\n]\n");
  file_.commit();
}

std::vector<Issue> visit_feature_records(const std::string& path,
                                         const std::function<void(FeatureRecord)>& visit) {
  std::vector<Issue> issues;
  const auto take = [&](const detail::RecordCells& cells) {
    FeatureRecord record;
    auto fault = fill(record, cells);
    if (!fault) visit(std::move(record));
    return fault;
  };
  detail::visit_records(path, take, issues);
  return issues;
}

Checked<std::vector<FeatureRecord>> read_feature_records(const std::string& path,
                                                         RecordColumns* columns) {
  Checked<std::vector<FeatureRecord>> result;
  std::vector<FeatureRecord> records;
  const auto take = [&](const detail::RecordCells& cells) {
    FeatureRecord record;
    auto fault = fill(record, cells);
    if (!fault) records.push_back(std::move(record));
    return fault;
  };
  if (detail::visit_records(path, take, result.issues, columns)) result.value = std::move(records);
  return result;
}

namespace detail {

bool visit_records(const std::string& path, const RecordTaker& take, std::vector<Issue>& issues,
                   RecordColumns* columns) {
  RecordColumns unused;
  RecordColumns& found = columns == nullptr ? unused : *columns;
  const RecordFormat format = format_to_use(path);
  const std::string text = Input(path).read_all();
  const std::string_view bare = without_bom(text);
  if (format == RecordFormat::csv) return visit_csv_records(bare, {path, 0}, take, issues, found);
  return visit_json_records(bare, {path, 0}, format == RecordFormat::jsonl, take, issues, found);
}

const std::vector<RelationKind>& recorded_relations() {
  static const std::vector<RelationKind> without_host = [] {
    std::vector<RelationKind> all = relation_schema();
    std::erase_if(all, [](const RelationKind& relation) { return relation.name == "host"; });
    return all;
  }();
  return without_host;
}

std::string to_string(const RelationClass& related) {
  return fmt::format("{}{}/{}", kClassMark, related.number, related.size);
}

std::optional<RelationClass> relation_class_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (!text.starts_with(kClassMark) || slash == std::string_view::npos) return std::nullopt;
  const auto number = as_whole(text.substr(1, slash - 1));
  const auto size = as_whole(text.substr(slash + 1));
  const auto fits = [](const auto& count) {
    return count && *count > 0 && *count <= std::numeric_limits<int>::max();
  };
  if (!fits(number) || !fits(size)) return std::nullopt;
  return RelationClass{static_cast<int>(*number), static_cast<int>(*size)};
}

std::optional<std::string> read_box(std::string_view cell, std::array<double, 6>& box) {
  if (cell.empty()) return std::nullopt;
  const std::vector<std::string> parts = split(cell);
  for (std::size_t i = 0; i < box.size(); ++i) {
    const auto number = i < parts.size() ? as_double(parts[i]) : std::nullopt;
    if (!number || parts.size() != box.size())
      return fmt::format("'aabb_m' is {}; expected six numbers", in_quotes(cell));
    box[i] = *number;
  }
  return std::nullopt;
}

std::string no_number(std::string_view field, std::string_view cell) {
  return fmt::format("'{}' is {}; expected a number", field, in_quotes(cell));
}

}  // namespace detail

}  // namespace oriel
