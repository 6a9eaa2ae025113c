#include "model/description/feature_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

FeatureTable::FeatureTable(std::string building, std::size_t rows)
    : building_(std::move(building)), ids_(rows), numbers_(rows, kMissing) {
  for (const Attribute attribute : kAttributes) {
    if (info_of(attribute).unit != Unit::text) continue;
    place_of_[column_of(attribute)] = static_cast<std::uint8_t>(texts_.size());
    texts_.emplace_back(rows);
  }
}

FeatureId FeatureTable::find(std::string_view id) const {
  const auto found = std::ranges::find(ids_, id);
  return found == ids_.end() ? FeatureId{} : FeatureId{static_cast<int>(found - ids_.begin())};
}

std::optional<double> FeatureTable::number(FeatureId row, Attribute attribute) const {
  const double value = numbers(attribute)[row.index()];
  if (std::isnan(value)) return std::nullopt;
  return value;
}

void FeatureTable::add_numbers(Attribute attribute) {
  constexpr std::size_t kUsual = 32;  // columns that are filled
  if (numbers_.size() == rows()) numbers_.reserve(kUsual * rows());
  place_of_[column_of(attribute)] = static_cast<std::uint8_t>(numbers_.size() / rows());
  numbers_.resize(numbers_.size() + rows(), kMissing);
}

}  // namespace oriel
