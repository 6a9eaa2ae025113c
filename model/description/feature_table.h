#pragma once

#include "kernel/base/assert.h"
#include "kernel/base/ids.h"
#include "model/description/attributes.h"
#include "model/description/word_column.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

/// Attributes of the features of one building: row = FeatureId, column = Attribute.
/// A missing value is missing, not 0: NaN in a column of numbers, empty in a
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

  /// The whole column, NaN where missing. Needs a number. Valid until a value is set.
  [[nodiscard]] std::span<const double> numbers(Attribute attribute) const {
    return std::span(numbers_).subspan(place_of(attribute) * rows(), rows());
  }
  /// The whole column, "" where missing. Needs a text.
  [[nodiscard]] const WordColumn& texts(Attribute attribute) const {
    return texts_[place_of(attribute)];
  }
  [[nodiscard]] std::optional<double> number(FeatureId row, Attribute attribute) const;
  [[nodiscard]] const std::string& text(FeatureId row, Attribute attribute) const {
    return texts(attribute)[row.index()];
  }

  /// Sets a value; the type of the attribute must fit.
  void set(FeatureId row, Attribute attribute, double value) {
    ORIEL_ASSERT(info_of(attribute).unit != Unit::text);
    if (place_of(attribute) == 0) add_numbers(attribute);
    numbers_[place_of(attribute) * rows() + row.index()] = value;
  }
  void set(FeatureId row, Attribute attribute, std::string value) {
    ORIEL_ASSERT(info_of(attribute).unit == Unit::text);
    texts_[place_of(attribute)].set(row.index(), std::move(value));
  }

 private:
  /// Which of the columns it is that stand in `numbers_` or in `texts_`.
  [[nodiscard]] std::size_t place_of(Attribute attribute) const {
    return place_of_[column_of(attribute)];
  }
  /// Makes place for a column of numbers, all missing.
  void add_numbers(Attribute attribute);

  std::string building_;
  std::vector<std::string> ids_;
  std::array<std::uint8_t, kAttributes.size()> place_of_{};
  /// Columns of numbers one behind the other, so that a building is one piece of memory. The first
  /// is that of all in which nothing was set.
  std::vector<double> numbers_;
  std::vector<WordColumn> texts_;
};

}  // namespace oriel
