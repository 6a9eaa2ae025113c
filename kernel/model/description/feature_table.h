#pragma once

#include "kernel/base/ids.h"
#include "kernel/model/description/word_column.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

  /// The whole column, NaN where missing. Needs a column of numbers. Valid until a value is set.
  [[nodiscard]] std::span<const double> numbers(std::size_t column) const {
    return std::span(numbers_).subspan(place_of_[column] * rows(), rows());
  }
  /// The whole column, "" where missing. Needs a column of texts.
  [[nodiscard]] const WordColumn& texts(std::size_t column) const {
    return texts_[place_of_[column]];
  }
  [[nodiscard]] std::optional<double> number(FeatureId row, std::size_t column) const;
  [[nodiscard]] std::optional<double> number(FeatureId row, std::string_view name) const;
  [[nodiscard]] const std::string& text(FeatureId row, std::string_view name) const;

  /// Sets a value. `name` must stand in the schema with a fitting type.
  void set(FeatureId row, std::string_view name, double value);
  void set(FeatureId row, std::string_view name, std::string value);
  /// The same by the column's position, whose type must fit.
  void set(FeatureId row, std::size_t column, double value) {
    if (place_of_[column] == 0) add_numbers(column);
    numbers_[place_of_[column] * rows() + row.index()] = value;
  }
  void set(FeatureId row, std::size_t column, std::string value) {
    texts_[place_of_[column]].set(row.index(), std::move(value));
  }

 private:
  /// Makes place for a column of numbers, all missing.
  void add_numbers(std::size_t column);

  std::string building_;
  std::vector<std::string> ids_;
  /// By column: which of the columns it is that stand in `numbers_` or in `texts_`.
  std::vector<std::uint32_t> place_of_;
  /// Columns of numbers one behind the other, so that a building is one piece of memory. The first
  /// is that of all in which nothing was set.
  std::vector<double> numbers_;
  std::vector<WordColumn> texts_;
};

}  // namespace oriel
