#pragma once

#include "model/building.h"
#include "model/segmentation.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace oriel {

/// For each polygon the features that list it.
class PolygonOwners {
 public:
  PolygonOwners() = default;
  /// `first` has the place of every polygon's first feature in `features`, and their number.
  PolygonOwners(std::vector<int> first, std::vector<int> features)
      : first_(std::move(first)), features_(std::move(features)) {}

  [[nodiscard]] std::size_t polygons() const { return first_.empty() ? 0 : first_.size() - 1; }
  [[nodiscard]] std::span<const int> operator[](std::size_t polygon) const {
    const auto begin = static_cast<std::size_t>(first_[polygon]);
    return {features_.data() + begin, static_cast<std::size_t>(first_[polygon + 1]) - begin};
  }

 private:
  std::vector<int> first_;
  std::vector<int> features_;
};

/// For each polygon (Polygon::source, below `polygons`) the features that list it, the smallest
/// first: by volume, where an imprint is as large as what it owns; of equal sizes the one with
/// fewer polygons, which is the inner one, then the later one. Throws std::logic_error if a feature
/// lists a polygon beyond.
PolygonOwners polygon_owners(const Segmentation& segmentation, std::size_t polygons);

/// The same for all polygons of a building.
PolygonOwners polygon_owners(const Segmentation& segmentation, const Building& building);

}  // namespace oriel
