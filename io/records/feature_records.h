#pragma once

#include "io/files/output_file.h"
#include "io/records/record_columns.h"
#include "model/building.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"
#include "model/segmentation.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace oriel {

/// A missing value, a number, or a text.
using RecordValue = std::variant<std::monostate, double, std::string>;

/// One feature of one building as it stands in a table of features: what the segmentation, the
/// attributes, the relations and (if there were rules) the verdict say of it. Ids are
/// content-based.
struct FeatureRecord {
  std::string building;
  std::string id;
  /// For people: feature_names().
  std::string name;
  /// The verdict; texts empty and numbers missing where there was no interpretation.
  std::string label;
  std::optional<double> score;
  std::optional<double> margin;
  std::string rule;
  std::string runner_up;
  /// Ids of the feature in whose subtree it was found and of the one it stands on; empty: the body.
  std::string parent;
  std::string host;
  /// xmin, ymin, zmin, xmax, ymax, zmax in the input's coordinates, in metres.
  std::array<double, 6> aabb_m{};
  /// Polygon::source of the polygons in it, sorted.
  std::vector<int> source_polygons;
  /// One value for each attribute of feature_schema(), in its order; yes/no is 1 and 0.
  std::vector<RecordValue> attributes;
  /// The ids it is related to, for each relation of relation_schema() but "host", in its order. Of
  /// same_facade, same_storey and alike one text where the features of the building fall into
  /// classes by it: "#3/12" for each of the twelve in its third class, which are all related.
  std::vector<std::vector<std::string>> relations;
  /// Ids of the groups it is in.
  std::vector<std::string> groups;
  /// Id of the labelled feature that it is a part of (wholes_by_feature()), or empty.
  std::string part_of;
  /// Who corrected the label and why, where somebody did.
  std::string corrected_by;
  std::string corrected_why;
};

/// The names of a record's fields: building, id, name, label, score, margin, rule, runner_up,
/// parent, host, aabb_m, source_polygons, record_name() of every attribute, rel_NAME, then groups,
/// part_of, corrected_by and corrected_why.
const std::vector<std::string>& record_fields();

/// The records of one building, in feature order. `table` and `graph` are those of `segmentation`;
/// `interpretation` may be null.
std::vector<FeatureRecord> feature_records(const Building& building,
                                           const Segmentation& segmentation,
                                           const FeatureTable& table, const FeatureGraph& graph,
                                           const Interpretation* interpretation);

/// Sets what the features of one building are related to; the records are those of all its
/// features, in their order.
void set_relations(std::vector<FeatureRecord>& records, const FeatureTable& table,
                   const FeatureGraph& graph);

/// Puts a verdict, the ids of its groups and of what it is a part of into a record in place of what
/// it says.
void set_verdict(FeatureRecord& record, const Verdict& verdict, std::vector<std::string> groups,
                 std::string part_of);

/// Names the features of a building anew, as its records say their labels and places.
void set_names(std::span<FeatureRecord> records);

/// The formats of records, by extension: .csv, .json (an array), .jsonl (an object a line).
enum class RecordFormat { csv, json, jsonl };
std::optional<RecordFormat> record_format_of(std::string_view path);

/// Writes records to a file, building by building. Numbers have the fewest digits that read back to
/// the same double. CSV is RFC 4180 with LF line ends: lists are joined by ';', missing values are
/// empty. JSON has arrays and null. Throws InputError E106 for another extension, OutputError E601.
class FeatureRecordWriter {
 public:
  /// With these columns only.
  explicit FeatureRecordWriter(const std::string& path, const RecordColumns& columns = {});
  void append(const std::vector<FeatureRecord>& records);
  /// The same in two steps, of which several threads may do the first: records as the format has
  /// them, without what stands before and between them; and putting such a text into the file.
  static std::string text(RecordFormat format, const std::vector<FeatureRecord>& records,
                          const RecordColumns& columns = {});
  void append(std::string_view text);
  /// Puts the file in its place, as OutputFile does.
  void commit();
  /// How many bytes it has so far.
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }

 private:
  RecordFormat format_;
  RecordColumns columns_;
  OutputFile file_;
  bool is_empty_ = true;
};

/// Reads records back. Fields may come in any order, unknown ones are passed over, absent ones are
/// missing, and `columns` says which (of JSON those that every record has); "building" and "id" are
/// needed. E111 with the line (of a JSON array: the record's number) for a record that cannot be
/// read, which is left out; E102 to E105 where the text is not even CSV or JSON. Throws InputError:
/// E101 the file cannot be read, E106 unknown extension.
Checked<std::vector<FeatureRecord>> read_feature_records(const std::string& path,
                                                         RecordColumns* columns = nullptr);

/// The same for tables that are large: `visit` gets one record after the other. Returns the issues.
std::vector<Issue> visit_feature_records(const std::string& path,
                                         const std::function<void(FeatureRecord)>& visit);

/// Appends a line of CSV (RFC 4180) with an LF at its end: cells with commas, quotes or line ends
/// stand in quotes.
void append_csv_line(std::string& out, const std::vector<std::string>& cells);

}  // namespace oriel
