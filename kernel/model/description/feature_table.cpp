#include "kernel/model/description/feature_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace oriel {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

std::size_t require_column(std::string_view name, bool is_text) {
  const auto column = column_of(name);
  if (!column || (feature_schema()[*column].unit == Unit::text) != is_text)
    throw std::logic_error("no attribute '" + std::string(name) + "' of that type in the schema");
  return *column;
}

}  // namespace

FeatureTable::FeatureTable(std::string building, std::size_t rows)
    : building_(std::move(building)),
      ids_(rows),
      place_of_(feature_schema().size(), 0),
      numbers_(rows, kMissing) {
  for (std::size_t c = 0; c < place_of_.size(); ++c) {
    if (feature_schema()[c].unit != Unit::text) continue;
    place_of_[c] = static_cast<std::uint32_t>(texts_.size());
    texts_.emplace_back(rows);
  }
}

FeatureId FeatureTable::find(std::string_view id) const {
  const auto found = std::ranges::find(ids_, id);
  return found == ids_.end() ? FeatureId{} : FeatureId{static_cast<int>(found - ids_.begin())};
}

std::optional<double> FeatureTable::number(FeatureId row, std::size_t column) const {
  const double value = numbers(column)[row.index()];
  if (std::isnan(value)) return std::nullopt;
  return value;
}

std::optional<double> FeatureTable::number(FeatureId row, std::string_view name) const {
  return number(row, require_column(name, false));
}

const std::string& FeatureTable::text(FeatureId row, std::string_view name) const {
  return texts(require_column(name, true))[row.index()];
}

void FeatureTable::add_numbers(std::size_t column) {
  constexpr std::size_t kUsual = 32;  // columns that are filled
  if (numbers_.size() == rows()) numbers_.reserve(kUsual * rows());
  place_of_[column] = static_cast<std::uint32_t>(numbers_.size() / rows());
  numbers_.resize(numbers_.size() + rows(), kMissing);
}

void FeatureTable::set(FeatureId row, std::string_view name, double value) {
  set(row, require_column(name, false), value);
}

void FeatureTable::set(FeatureId row, std::string_view name, std::string value) {
  set(row, require_column(name, true), std::move(value));
}

}  // namespace oriel
