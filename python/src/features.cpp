#include "oriel/energy.h"
#include "oriel/explain.h"
#include "oriel/interpret.h"
#include "oriel/rules.h"
#include "oriel/write.h"
#include "python/src/handles.h"

#include <algorithm>
#include <limits>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace py = pybind11;

namespace oriel::python {

namespace {

using Results = std::vector<std::shared_ptr<const StageResult>>;

FeatureId row_id(std::size_t row) { return FeatureId{static_cast<int>(row)}; }

std::string id_or_none(const FeatureTable& table, FeatureId feature) {
  return feature.is_valid() ? table.id(feature) : "";
}

/// The features of buildings that came to them; the others have none.
FeatureSet features_of(const Results& results) {
  auto buildings = std::make_shared<std::vector<DescribedBuilding>>();
  auto rows = std::make_shared<std::vector<std::vector<StoredRow>>>();
  FeatureSet set;
  for (const auto& one : results) {
    const PipelineResult& result = one->result();
    if (!result.is_done()) continue;
    const FeatureTable& table = result.description.table;
    buildings->push_back({table, result.description.graph});
    rows->emplace_back();
    for (const Feature& feature : result.segmentation->features)
      rows->back().push_back({feature.box.moved(one->building().frame.origin_m),
                              id_or_none(table, feature.parent), id_or_none(table, feature.host),
                              feature.source_polygons, "", ""});
    for (const LabelCorrection& correction : result.corrections) {
      StoredRow& row = rows->back().at(correction.before.feature.index());
      row.corrected_by = correction.by;
      row.corrected_why = correction.why;
    }
    set.labels.push_back(result.interpretation);
    set.labels.back().issues.clear();
  }
  set.buildings = std::move(buildings);
  set.rows = std::move(rows);
  return set;
}

/// The rows of the table `energy` or `envelope` of labelled buildings, as a JSON array.
std::string energy_text(const Results& results, const std::string& table,
                        const std::vector<std::string>& unheated) {
  const EnergyTable kind =
      table == to_string(EnergyTable::envelope) ? EnergyTable::envelope : EnergyTable::buildings;
  std::unordered_map<const Document*, std::vector<std::optional<int>>> storeys;
  std::string text = "[";
  for (const auto& one : results) {
    if (!one->rules()) throw py::value_error("energy needs labels: the results of label()");
    if (const auto unknown = unknown_class(*one->rules(), {unheated}); !unknown.empty())
      throw py::value_error(unknown);
    const Document& document = one->of().document();
    auto stated = storeys.find(&document);
    if (stated == storeys.end())
      stated = storeys.emplace(&document, stated_storeys(document)).first;
    const auto place = static_cast<std::size_t>(&one->of().building() - document.buildings.data());
    BuildingEnergy of =
        energy_of(one->building(), one->result(), *one->rules(), one->options(), {unheated});
    if (const auto number = stated->second.at(place)) {
      of.storeys = number;
      of.storeys_source = "attribute";
    }
    const std::string rows = energy_rows(kind, TableFormat::json, of);
    if (text.size() > 1 && !rows.empty()) text += ",";
    text += rows;
  }
  return text + "]";
}

/// The verdict of a record, put among those of its building; the groups by their members.
void take_verdict(const FeatureRecord& record, FeatureId row, Interpretation& labels) {
  labels.verdicts[row.index()] = {row,
                                  Name(record.label),
                                  record.score.value_or(0),
                                  record.margin.value_or(0),
                                  Name(record.rule),
                                  Name(record.runner_up)};
  for (const std::string& id : record.groups) {
    auto group = std::ranges::find(labels.groups, id, &Group::id);
    if (group == labels.groups.end()) {
      labels.groups.push_back({id, id.substr(0, id.find('.')), {}});
      group = std::prev(labels.groups.end());
    }
    group->members.push_back(row);
  }
}

FeatureSet read_features(const std::string& path) {
  FeatureSet set;
  auto tables = read_feature_tables(path);
  set.issues = std::move(tables.issues);
  auto buildings = std::make_shared<std::vector<DescribedBuilding>>();
  if (tables.value) *buildings = std::move(*tables.value);
  auto rows = std::make_shared<std::vector<std::vector<StoredRow>>>();
  set.labels.resize(buildings->size());
  std::unordered_map<std::string, std::size_t> place_of_building;
  for (std::size_t i = 0; i < buildings->size(); ++i) {
    const std::size_t features = (*buildings)[i].table.rows();
    rows->emplace_back(features);
    set.labels[i].verdicts.resize(features);
    place_of_building.emplace((*buildings)[i].table.building(), i);
  }
  bool has_labels = false;
  visit_feature_records(path, [&](FeatureRecord record) {
    const auto building = place_of_building.find(record.building);
    if (building == place_of_building.end()) return;
    const FeatureId row = (*buildings)[building->second].table.find(record.id);
    if (!row.is_valid()) return;
    const auto& b = record.aabb_m;
    has_labels = has_labels || record.score.has_value();
    take_verdict(record, row, set.labels[building->second]);
    (*rows)[building->second][row.index()] = {
        {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}, record.parent,       record.host,
        std::move(record.source_polygons),        record.corrected_by, record.corrected_why};
  });
  if (!has_labels) set.labels.assign(buildings->size(), {});
  set.buildings = std::move(buildings);
  set.rows = std::move(rows);
  return set;
}

FeatureSet interpret_features(const FeatureSet& set, const RuleBase& rules) {
  FeatureSet labelled{set.buildings, set.rows, interpret(rules, *set.buildings), {}};
  for (Interpretation& building : labelled.labels) {
    labelled.issues.insert(labelled.issues.end(), building.issues.begin(), building.issues.end());
    building.issues.clear();
  }
  return labelled;
}

std::vector<FeatureId> hosts_of(const FeatureSet& set, std::size_t building) {
  std::vector<FeatureId> hosts;
  const FeatureTable& table = (*set.buildings)[building].table;
  for (const StoredRow& row : (*set.rows)[building])
    hosts.push_back(row.host.empty() ? FeatureId{} : table.find(row.host));
  return hosts;
}

/// By row, as feature_records() names them.
std::vector<std::string> names_in(const FeatureSet& set, std::size_t building) {
  const FeatureTable& table = (*set.buildings)[building].table;
  const std::vector<FeatureId> hosts = hosts_of(set, building);
  const std::vector<Verdict>& verdicts = set.labels[building].verdicts;
  std::vector<NameParts> parts;
  for (std::size_t i = 0; i < table.rows(); ++i)
    parts.push_back(
        {table.id(row_id(i)), verdicts.empty() ? std::string_view() : verdicts[i].label.text(),
         hosts[i], table.number(row_id(i), Attribute::host_inclination),
         table.number(row_id(i), Attribute::azimuth),
         table.number(row_id(i), Attribute::storey).has_value(), (*set.rows)[building][i].box});
  return feature_names(parts);
}

std::vector<RecordValue> values_of(const FeatureTable& table, FeatureId row) {
  std::vector<RecordValue> values;
  for (const Attribute attribute : kAttributes) {
    values.emplace_back();
    if (info_of(attribute).unit == Unit::text) {
      if (const std::string& text = table.text(row, attribute); !text.empty()) values.back() = text;
    } else if (const auto number = table.number(row, attribute)) {
      values.back() = *number;
    }
  }
  return values;
}

/// Who corrected a feature, or why; empty where nobody did.
std::string correction_part(const FeatureSet& set, std::size_t b, std::size_t i,
                            std::string StoredRow::*part) {
  const auto& verdicts = set.labels[b].verdicts;
  const bool is_corrected = !verdicts.empty() && verdicts[i].rule.text() == kCorrectedRule;
  return is_corrected ? (*set.rows)[b][i].*part : std::string();
}

/// Calls visit(building, row) for each feature of the set.
template <class Visit>
void for_each_feature(const FeatureSet& set, const Visit& visit) {
  for (std::size_t b = 0; b < set.buildings->size(); ++b)
    for (std::size_t i = 0; i < (*set.buildings)[b].table.rows(); ++i) visit(b, i);
}

/// A column of texts by what gives the text of a building and a row.
template <class Text>
std::vector<std::string> text_column(const FeatureSet& set, const Text& text) {
  std::vector<std::string> column;
  column.reserve(set.feature_count());
  for_each_feature(set, [&](std::size_t b, std::size_t i) { column.push_back(text(b, i)); });
  return column;
}

/// A column of what is known of each building by row.
template <class Column>
std::vector<std::string> column_by_building(const FeatureSet& set, const Column& of_building) {
  std::vector<std::string> column;
  for (std::size_t b = 0; b < set.buildings->size(); ++b)
    for (std::string& text : of_building(b)) column.push_back(std::move(text));
  return column;
}

std::vector<std::string> parts_of(const FeatureSet& set, std::size_t building) {
  std::vector<std::string> ids((*set.rows)[building].size());
  if (set.labels[building].verdicts.empty()) return ids;
  const auto wholes = wholes_by_feature(set.labels[building], hosts_of(set, building));
  for (std::size_t i = 0; i < ids.size(); ++i)
    ids[i] = id_or_none((*set.buildings)[building].table, wholes[i]);
  return ids;
}

std::vector<std::string> groups_in(const FeatureSet& set, std::size_t building) {
  std::vector<std::string> texts((*set.rows)[building].size());
  if (set.labels[building].verdicts.empty()) return texts;
  const auto groups = groups_by_feature(set.labels[building]);
  for (std::size_t i = 0; i < texts.size(); ++i)
    texts[i] = fmt::format("{}", fmt::join(groups[i], ";"));
  return texts;
}

/// A column of texts; nothing if no text is called so.
std::optional<std::vector<std::string>> texts_named(const FeatureSet& set,
                                                    const std::string& name) {
  const auto verdict_text = [&](Name Verdict::*part) {
    return text_column(set, [&](std::size_t b, std::size_t i) {
      const auto& verdicts = set.labels[b].verdicts;
      return verdicts.empty() ? std::string() : (verdicts[i].*part).text();
    });
  };
  const auto row_text = [&](std::string StoredRow::*part) {
    return text_column(set, [&](std::size_t b, std::size_t i) { return (*set.rows)[b][i].*part; });
  };
  const auto table = [&](std::size_t b) -> const FeatureTable& {
    return (*set.buildings)[b].table;
  };
  if (name == "building")
    return text_column(set, [&](std::size_t b, std::size_t) { return table(b).building(); });
  if (name == "id")
    return text_column(set, [&](std::size_t b, std::size_t i) { return table(b).id(row_id(i)); });
  if (name == "name")
    return column_by_building(set, [&](std::size_t b) { return names_in(set, b); });
  if (name == "label") return verdict_text(&Verdict::label);
  if (name == "rule") return verdict_text(&Verdict::rule);
  if (name == "runner_up") return verdict_text(&Verdict::runner_up);
  const auto corrected_text = [&](std::string StoredRow::*part) {
    return text_column(
        set, [&](std::size_t b, std::size_t i) { return correction_part(set, b, i, part); });
  };
  if (name == "corrected_by") return corrected_text(&StoredRow::corrected_by);
  if (name == "corrected_why") return corrected_text(&StoredRow::corrected_why);
  if (name == "parent") return row_text(&StoredRow::parent);
  if (name == "host") return row_text(&StoredRow::host);
  if (name == "groups")
    return column_by_building(set, [&](std::size_t b) { return groups_in(set, b); });
  if (name == "part_of")
    return column_by_building(set, [&](std::size_t b) { return parts_of(set, b); });
  for (const Attribute attribute : kAttributes)
    if (info_of(attribute).unit == Unit::text && record_name(info_of(attribute)) == name)
      return text_column(
          set, [&](std::size_t b, std::size_t i) { return table(b).text(row_id(i), attribute); });
  return std::nullopt;
}

constexpr std::array kBoxColumns = {"xmin_m", "ymin_m", "zmin_m", "xmax_m", "ymax_m", "zmax_m"};

/// A column of numbers, NaN where missing; nothing if no number is called so.
std::optional<py::array_t<double>> numbers_named(const FeatureSet& set, const std::string& name) {
  py::array_t<double> column(static_cast<py::ssize_t>(set.feature_count()));
  double* at = column.mutable_data();
  const auto fill = [&](const auto& number) {
    for_each_feature(set, [&](std::size_t b, std::size_t i) { *at++ = number(b, i); });
    return column;
  };
  const auto verdict_number = [&](double Verdict::*part) {
    return fill([&](std::size_t b, std::size_t i) {
      const auto& verdicts = set.labels[b].verdicts;
      return verdicts.empty() ? std::numeric_limits<double>::quiet_NaN() : verdicts[i].*part;
    });
  };
  if (name == "score") return verdict_number(&Verdict::score);
  if (name == "margin") return verdict_number(&Verdict::margin);
  for (std::size_t k = 0; k < kBoxColumns.size(); ++k)
    if (name == kBoxColumns[k])
      return fill([&](std::size_t b, std::size_t i) {
        const Box& box = (*set.rows)[b][i].box;
        return std::array{box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z}[k];
      });
  for (const Attribute attribute : kAttributes) {
    if (info_of(attribute).unit == Unit::text || record_name(info_of(attribute)) != name) continue;
    for (const DescribedBuilding& building : *set.buildings)
      at = std::ranges::copy(building.table.numbers(attribute), at).out;
    return column;
  }
  return std::nullopt;
}

py::object column_named(const FeatureSet& set, const std::string& name) {
  if (auto texts = texts_named(set, name)) return py::cast(std::move(*texts));
  if (auto numbers = numbers_named(set, name)) return std::move(*numbers);
  throw py::key_error(name);
}

/// The names of all columns, in the order of the records.
std::vector<std::string> column_names() {
  std::vector<std::string> names;
  for (const std::string& field : record_fields()) {
    if (field == "aabb_m")
      names.insert(names.end(), kBoxColumns.begin(), kBoxColumns.end());
    else if (field != "source_polygons" && !field.starts_with("rel_"))
      names.push_back(field);
  }
  return names;
}

/// Lists as two arrays: those of row i are others[starts[i]] ... others[starts[i + 1] - 1].
using ListArrays = std::pair<py::array_t<std::int64_t>, py::array_t<std::int64_t>>;

ListArrays arrays_of(const std::vector<std::int64_t>& starts,
                     const std::vector<std::int64_t>& others) {
  return {py::array_t<std::int64_t>(static_cast<py::ssize_t>(starts.size()), starts.data()),
          py::array_t<std::int64_t>(static_cast<py::ssize_t>(others.size()), others.data())};
}

/// A relation between rows of all buildings, or "source_polygons".
ListArrays lists_named(const FeatureSet& set, const std::string& name) {
  const bool is_relation = std::ranges::any_of(
      relation_schema(), [&](const RelationKind& relation) { return relation.name == name; });
  if (!is_relation && name != "source_polygons") throw py::key_error(name);
  std::vector<std::int64_t> starts{0}, others;
  std::int64_t first_row = 0;
  for (std::size_t b = 0; b < set.buildings->size(); ++b) {
    const DescribedBuilding& building = (*set.buildings)[b];
    for (std::size_t i = 0; i < building.table.rows(); ++i) {
      if (is_relation)
        for (const FeatureId other : building.graph.others(name, row_id(i)))
          others.push_back(first_row + other.value);
      else
        for (const int polygon : (*set.rows)[b][i].source_polygons) others.push_back(polygon);
      starts.push_back(static_cast<std::int64_t>(others.size()));
    }
    first_row += static_cast<std::int64_t>(building.table.rows());
  }
  return arrays_of(starts, others);
}

std::vector<std::string> list_names() {
  std::vector<std::string> names;
  for (const RelationKind& relation : relation_schema()) names.push_back(relation.name);
  names.emplace_back("source_polygons");
  return names;
}

void write_features(const std::string& path, const FeatureSet& set) {
  FeatureRecordWriter writer(path);
  for (std::size_t b = 0; b < set.buildings->size(); ++b) writer.append(records_of(set, b, true));
  writer.commit();
}

/// Name in records, name in rules, unit, meaning, and the words that a text can be.
py::list schema_rows() {
  py::list rows;
  for (std::size_t i = 0; i < kAttributes.size(); ++i) {
    const AttributeInfo& info = feature_schema()[i];
    rows.append(py::make_tuple(record_name(info), info.name, attribute_words()[i].unit,
                               info.meaning, info.words));
  }
  return rows;
}

}  // namespace

std::size_t FeatureSet::feature_count() const {
  std::size_t count = 0;
  for (const DescribedBuilding& building : *buildings) count += building.table.rows();
  return count;
}

std::vector<FeatureRecord> records_of(const FeatureSet& set, std::size_t building, bool is_whole) {
  const DescribedBuilding& described = (*set.buildings)[building];
  const Interpretation& labels = set.labels[building];
  const bool has_labels = !labels.verdicts.empty();
  std::vector<std::string> names, parts;
  std::vector<std::vector<std::string>> groups(described.table.rows());
  if (is_whole) names = names_in(set, building);
  if (is_whole) parts = parts_of(set, building);
  if (is_whole && has_labels) groups = groups_by_feature(labels);
  std::vector<FeatureRecord> records;
  for (std::size_t i = 0; i < described.table.rows(); ++i) {
    const StoredRow& row = (*set.rows)[building][i];
    FeatureRecord& record = records.emplace_back();
    record.building = described.table.building();
    record.id = described.table.id(row_id(i));
    record.parent = row.parent;
    record.host = row.host;
    record.aabb_m = {row.box.min.x, row.box.min.y, row.box.min.z,
                     row.box.max.x, row.box.max.y, row.box.max.z};
    record.source_polygons = row.source_polygons;
    if (is_whole) record.attributes = values_of(described.table, row_id(i));
    record.corrected_by = correction_part(set, building, i, &StoredRow::corrected_by);
    record.corrected_why = correction_part(set, building, i, &StoredRow::corrected_why);
    if (has_labels)
      set_verdict(record, labels.verdicts[i], std::move(groups[i]), is_whole ? parts[i] : "");
    if (is_whole) record.name = std::move(names[i]);
  }
  if (is_whole) set_relations(records, described.table, described.graph);
  return records;
}

void bind_features(py::module_& module) {
  py::class_<FeatureSet>(module, "FeatureSet", "Features apart from their buildings.")
      .def_readonly("issues", &FeatureSet::issues)
      .def_property_readonly("features", &FeatureSet::feature_count)
      .def_property_readonly("buildings",
                             [](const FeatureSet& set) {
                               std::vector<std::string> ids;
                               for (const auto& building : *set.buildings)
                                 ids.push_back(building.table.building());
                               return ids;
                             })
      .def("column", &column_named)
      .def("lists", &lists_named);
  module.def("features_of", &features_of, Unlocked());
  module.def("energy_text", &energy_text, Unlocked());
  module.def("read_features", &read_features, Unlocked());
  module.def("interpret", &interpret_features, Unlocked());
  module.def("write_features", &write_features, Unlocked());
  module.def("column_names", &column_names);
  module.def("list_names", &list_names);
  module.def("schema_rows", &schema_rows);
  module.def("relation_rows", [] {
    py::list rows;
    for (const RelationKind& relation : relation_schema())
      rows.append(py::make_tuple(relation.name, relation.meaning));
    return rows;
  });
}

}  // namespace oriel::python
