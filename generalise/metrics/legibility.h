#pragma once

#include "generalise/metrics/facade_quality.h"
#include "model/description/feature_table.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <optional>
#include <vector>

namespace oriel {

/// What of a drawing is smallest, and how much of it is below the least length of the target. A
/// length is missing where there is nothing of the kind.
struct Legibility {
  std::optional<double> smallest_edge_m;
  /// Between parallel facets that look at each other over air; sought up to kGapReach times the
  /// least length.
  std::optional<double> smallest_gap_m;
  int narrow_gaps = 0;
  /// Between openings of a facade (opening_gaps).
  std::optional<double> smallest_opening_gap_m;
  int narrow_opening_gaps = 0;
  /// The middle extent (Attribute::b) of features: of a recess its smaller side in the wall.
  std::optional<double> smallest_width_m;
  int narrow_features = 0;
};

inline constexpr double kGapReach = 4;

/// Of a drawing with these openings. `features` are those that are found in it; null: widths are
/// missing.
Legibility legibility_of(const Solid& drawn, const std::vector<WrittenOpening>& openings,
                         const FeatureTable* features, double least_m);

}  // namespace oriel
