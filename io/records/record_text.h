#pragma once

#include "io/json/text.h"
#include "io/records/feature_records.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// Appends the record as a line of CSV, or as a JSON object without line end.
void append_csv_record(std::string& out, const FeatureRecord& record, const RecordColumns& columns);
void append_json_record(std::string& out, const FeatureRecord& record,
                        const RecordColumns& columns);

/// Positions of fields in record_fields(): attributes follow these, then relations, then groups,
/// part_of, corrected_by and corrected_why.
namespace record_field {
inline constexpr std::size_t building = 0, id = 1, name = 2, label = 3, score = 4, margin = 5,
                             rule = 6, runner_up = 7, parent = 8, host = 9, aabb_m = 10,
                             source_polygons = 11, first_attribute = 12;
}

/// The values of a record in their CSV form, by position in record_fields(); empty where missing.
using RecordCells = std::vector<std::string_view>;

/// Takes a record; its cells are valid during the call only. Says what is wrong with it.
using RecordTaker = std::function<std::optional<std::string>(const RecordCells&)>;

/// Gives `take` the records of a text, in their order. What is wrong with one of them is an issue
/// E111. False if the text is no table of records at all. `columns` becomes what the table has.
bool visit_csv_records(std::string_view text, const TextName& name, const RecordTaker& take,
                       std::vector<Issue>& issues, RecordColumns& columns);
/// The same of an array of records, or with `is_lines` of one object a line.
bool visit_json_records(std::string_view text, const TextName& name, bool is_lines,
                        const RecordTaker& take, std::vector<Issue>& issues,
                        RecordColumns& columns);
/// The same of a file, by its extension. Throws InputError as read_feature_records does.
bool visit_records(const std::string& path, const RecordTaker& take, std::vector<Issue>& issues,
                   RecordColumns* columns = nullptr);

/// The relations that have a field rel_NAME, in its order: all but "host".
const std::vector<RelationKind>& recorded_relations();

/// What stands for a class of related features (FeatureRecord::relations).
struct RelationClass {
  int number = 0;  ///< from 1
  int size = 0;    ///< of its features
};
constexpr char kClassMark = '#';
std::string to_string(const RelationClass& related);
/// Nothing if the text is no class.
std::optional<RelationClass> relation_class_of(std::string_view text);

/// Reads a box, xmin;ymin;zmin;xmax;ymax;zmax; an empty cell changes nothing. Says what is wrong
/// with the cell.
std::optional<std::string> read_box(std::string_view cell, std::array<double, 6>& box);

/// What is no number in a field of numbers.
std::string no_number(std::string_view field, std::string_view cell);

/// Calls `visit` with each part of a list joined by ';'.
template <class Visit>
void for_each_part(std::string_view list, const Visit& visit) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(';'), list.size());
    visit(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
}

}  // namespace oriel::detail
