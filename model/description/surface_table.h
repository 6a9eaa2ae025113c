#pragma once

#include "model/description/attributes.h"
#include "model/description/word_column.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// Attributes of the surfaces of one building: row = position of the polygon in Building::polygons
/// (or of the facet in Solid::facets), column = SurfaceAttribute. A missing value is
/// missing, not 0: NaN in a column of numbers, empty in a column of texts. Yes/no stands as 1 and 0
/// among the numbers.
class SurfaceTable {
 public:
  SurfaceTable() = default;
  /// A table of `rows` surfaces, all values missing.
  explicit SurfaceTable(std::size_t rows);

  [[nodiscard]] std::size_t rows() const { return rows_; }

  /// The whole column; empty for a text.
  [[nodiscard]] const std::vector<double>& numbers(SurfaceAttribute attribute) const {
    return columns_[column_of(attribute)].numbers;
  }
  /// The whole column; empty for a number.
  [[nodiscard]] const WordColumn& texts(SurfaceAttribute attribute) const {
    return columns_[column_of(attribute)].texts;
  }
  [[nodiscard]] std::optional<double> number(std::size_t row, SurfaceAttribute attribute) const {
    const double value = numbers(attribute)[row];
    return std::isnan(value) ? std::nullopt : std::optional(value);
  }
  [[nodiscard]] const std::string& text(std::size_t row, SurfaceAttribute attribute) const {
    return texts(attribute)[row];
  }
  /// Sets a value; the type of the attribute must fit.
  void set(std::size_t row, SurfaceAttribute attribute, double value) {
    columns_[column_of(attribute)].numbers[row] = value;
  }
  void set(std::size_t row, SurfaceAttribute attribute, std::string value) {
    columns_[column_of(attribute)].texts.set(row, std::move(value));
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
