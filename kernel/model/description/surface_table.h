#pragma once

#include "kernel/model/description/feature_table.h"
#include "kernel/model/description/word_column.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

/// All attributes of surfaces, in the order of their columns: the contract between
/// describe_surfaces (which fills the values) and the `surfaces:` rules of a pack.
const std::vector<Attribute>& surface_schema();

/// The column of the attribute `name` in surface_schema(), or nothing.
std::optional<std::size_t> surface_column_of(std::string_view name);

/// Attributes of the surfaces of one building: row = position of the polygon in Building::polygons
/// (or of the facet in Solid::facets), column = position in surface_schema(). A missing value is
/// missing, not 0: NaN in a column of numbers, empty in a column of texts. Yes/no stands as 1 and 0
/// among the numbers.
class SurfaceTable {
 public:
  SurfaceTable() = default;
  /// A table of `rows` surfaces, all values missing.
  explicit SurfaceTable(std::size_t rows);

  [[nodiscard]] std::size_t rows() const { return rows_; }

  /// The whole column; empty for a column of texts.
  [[nodiscard]] const std::vector<double>& numbers(std::size_t column) const {
    return columns_[column].numbers;
  }
  /// The whole column; empty for a column of numbers.
  [[nodiscard]] const WordColumn& texts(std::size_t column) const { return columns_[column].texts; }
  /// `name` must stand in the schema with a fitting type.
  [[nodiscard]] std::optional<double> number(std::size_t row, std::string_view name) const;
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view name) const;
  void set(std::size_t row, std::string_view name, double value);
  void set(std::size_t row, std::string_view name, std::string value);
  /// The same by the column's position, whose type must fit.
  void set(std::size_t row, std::size_t column, double value) {
    columns_[column].numbers[row] = value;
  }
  void set(std::size_t row, std::size_t column, std::string value) {
    columns_[column].texts.set(row, std::move(value));
  }

 private:
  struct Column {
    std::vector<double> numbers;
    WordColumn texts;
  };
  std::size_t rows_ = 0;
  std::vector<Column> columns_;
};

}  // namespace oriel
