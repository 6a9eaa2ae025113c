#pragma once

#include "kernel/base/work.h"
#include "kernel/describe/features/shape.h"
#include "model/segmentation.h"

#include <map>
#include <optional>
#include <vector>

namespace oriel::detail {

/// The facades of a building. A facade is one facet of a cell; of what lies in the front of
/// something flat before a wall, as stairs do before a plinth, the wall's.
class Facades {
 public:
  /// Walls that are looked at are counted in `work`, which must outlive it; once it is used up a
  /// facade is its own facet only.
  Facades(const Segmentation& segmentation, Work& work);

  /// The facet of a feature's facade; nothing without cap.
  [[nodiscard]] std::optional<CellFacet> of(const Feature& feature);

  /// Of each feature, counted in feature order; -1 without cap. What an imprint owns has the
  /// imprint as its facade, as what stands in a recess has the back of the recess.
  [[nodiscard]] std::vector<int> numbers();

 private:
  /// A steep facet of a cell, its normal pointing out of the building.
  struct Wall {
    CellFacet facet;
    Vec3 normal;
    double offset_m = 0;
    Extent across, height;
    [[nodiscard]] double size() const { return across.size() * height.size(); }
  };
  [[nodiscard]] std::optional<Wall> wall_of(CellFacet facet) const;
  [[nodiscard]] CellFacet behind(CellFacet front) const;

  const Segmentation& segmentation_;
  Work& work_;
  std::vector<Wall> walls_;  ///< of solid cells
  std::map<std::pair<CellId, int>, CellFacet> known_;
};

}  // namespace oriel::detail
