#pragma once

#include "kernel/model/ids.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// The unit of an attribute, and so its type in a rule.
enum class Unit { text, yes_no, count, ratio, metre, square_metre, cubic_metre, degree };

/// "m", "m2", "m3", "deg"; empty for the others.
std::string_view suffix_of(Unit unit);

/// One attribute of features. The schema is the contract between describe (which fills the values),
/// interpret (which checks rules against it before any building is read) and the records that are
/// written.
struct Attribute {
  std::string name;
  Unit unit = Unit::ratio;
  std::string meaning;
  /// The section of the paper, or "rules.md", that asks for it.
  std::string source;
};

/// All attributes, in the order of their columns.
const std::vector<Attribute>& feature_schema();

/// The column of the attribute `name`, or nothing.
std::optional<std::size_t> column_of(std::string_view name);

/// The name that records carry: the attribute's name with its unit (`height_m`, `quality`).
std::string record_name(const Attribute& attribute);

/// The names of the relations that describe makes (FeatureGraph), with their meaning: self ->
/// other.
struct RelationKind {
  std::string name;
  std::string meaning;
};
const std::vector<RelationKind>& relation_schema();

/// Attributes of the features of one building: row = FeatureId, column = position in
/// feature_schema(). A missing value is missing, not 0: NaN in a column of numbers, empty in a
/// column of texts. Yes/no stands as 1 and 0 among the numbers.
class FeatureTable {
 public:
  FeatureTable() = default;
  /// A table of `rows` features, all values missing.
  FeatureTable(std::string building, std::size_t rows);

  [[nodiscard]] const std::string& building() const { return building_; }
  [[nodiscard]] std::size_t rows() const { return ids_.size(); }

  /// The content-based id of a feature: an NCName, the same under shuffled input and other rules.
  [[nodiscard]] const std::string& id(FeatureId row) const { return ids_[row.index()]; }
  void set_id(FeatureId row, std::string id) { ids_[row.index()] = std::move(id); }
  /// The feature with that id, or an invalid one.
  [[nodiscard]] FeatureId find(std::string_view id) const;

  /// The whole column, NaN where missing; empty for a column of texts.
  [[nodiscard]] const std::vector<double>& numbers(std::size_t column) const {
    const Column& c = columns_[column];
    return c.numbers.empty() && c.texts.empty() ? missing_ : c.numbers;
  }
  /// The whole column, "" where missing; empty for a column of numbers.
  [[nodiscard]] const std::vector<std::string>& texts(std::size_t column) const {
    return columns_[column].texts;
  }
  [[nodiscard]] std::optional<double> number(FeatureId row, std::size_t column) const;
  [[nodiscard]] std::optional<double> number(FeatureId row, std::string_view name) const;
  [[nodiscard]] const std::string& text(FeatureId row, std::string_view name) const;

  /// Sets a value. `name` must stand in the schema with a fitting type.
  void set(FeatureId row, std::string_view name, double value);
  void set(FeatureId row, std::string_view name, std::string value);
  /// The same by the column's position, whose type must fit.
  void set(FeatureId row, std::size_t column, double value);
  void set(FeatureId row, std::size_t column, std::string value) {
    columns_[column].texts[row.index()] = std::move(value);
  }

 private:
  struct Column {
    /// Empty before the first value is set.
    std::vector<double> numbers;
    std::vector<std::string> texts;
  };
  std::string building_;
  std::vector<std::string> ids_;
  std::vector<Column> columns_;
  /// What a column of numbers is in which nothing was set.
  std::vector<double> missing_;
};

}  // namespace oriel
