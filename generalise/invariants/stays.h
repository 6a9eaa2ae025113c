#pragma once

#include "model/segmentation.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace oriel::detail {

/// A feature that is to stay would lose all its surface: none of its input polygons are named by a
/// facet of `left`, but some are by one of `before`. `gone`: features that go, with all that goes
/// along. What has the polygons of features that are gone was made of them, and is not asked for.
bool loses_what_stays(const Solid& before, const Solid& left, const Segmentation& segmentation,
                      const std::vector<FeatureId>& gone);
/// The same of the polygons that are named.
bool loses_what_stays(const std::set<int>& before, const std::set<int>& left,
                      const Segmentation& segmentation, const std::vector<FeatureId>& gone);
/// The input polygons that the facets of a solid name.
std::set<int> polygons_named(const Solid& solid);

/// The features that are not among the `removed` (ascending).
class StayingFeatures {
 public:
  StayingFeatures(const Segmentation& segmentation, const std::vector<FeatureId>& removed);

  /// Why a facet of what is left cannot be taken out: an outline of such a feature will be drawn in
  /// it, or all its polygons are of such features. Nothing if it can.
  [[nodiscard]] std::optional<std::string> why_it_stays(const Solid& left,
                                                        const Facet& facet) const;

 private:
  std::vector<Vec3> outlines_;  ///< a corner of each
  std::vector<int> polygons_;   ///< ascending
};

}  // namespace oriel::detail
