#pragma once

#include "model/segmentation.h"

#include <array>
#include <span>
#include <vector>

namespace oriel::detail {

/// The smallest box around points that stands on the z-axis: one pair of sides is vertical, and
/// turned in plan so that the plan area is least.
struct StandingBox {
  double length = 0;  ///< the longer side in plan
  double breadth = 0;
  double height = 0;
  Vec3 along;  ///< horizontal unit vector of `length`

  /// All three edges, longest first: the paper's a ≥ b ≥ c.
  [[nodiscard]] std::array<double, 3> edges() const;
};

StandingBox standing_box(std::span<const Vec3> points);

/// The least and largest coordinate of points along a direction.
struct Extent {
  double low = Box::kInfinity;
  double high = -Box::kInfinity;
  [[nodiscard]] double size() const { return high - low; }
  [[nodiscard]] double middle() const { return (low + high) / 2; }
};

Extent extent_along(std::span<const Vec3> points, Vec3 direction);

/// The points of a feature.
std::vector<Vec3> points_of(const Segmentation& segmentation, const Feature& feature);

/// The points of a cell, of all its facets.
std::vector<Vec3> points_of(const Segmentation& segmentation, const Cell& cell);

/// A facet of a cell as outlines.
std::vector<std::vector<Vec3>> facet_outlines(const Segmentation& segmentation,
                                              const CellFacet& facet);

}  // namespace oriel::detail
