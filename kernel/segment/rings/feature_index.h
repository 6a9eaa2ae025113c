#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/rings/rings.h"
#include "model/segmentation.h"
#include "model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// The features that a segmentation has so far, to be found by the planes of their caps. What is
/// appended later is none of them.
class FeatureIndex {
 public:
  /// What is looked at is counted in `work`, which must outlive it.
  FeatureIndex(const Segmentation& segmentation, const Tolerances& tolerances, Work& work);

  /// The features with a cap within a rectangle of a plane, from left to right.
  [[nodiscard]] std::vector<FeatureId> within(PlaneId plane, const Reach& reach);

  /// True if the cap of one of them fills 0.8 of the rectangle: it is the ring's. So it is if the
  /// ring runs around what a part with that facet was cut off. Once the work is used up all are.
  [[nodiscard]] bool fills(PlaneId plane, const Reach& reach);

 private:
  struct PlacedCap {
    FeatureId id;
    Reach cap;  ///< of its points in that plane
  };
  struct OfPlane {
    bool is_known = false;  ///< caps are measured when they are asked for
    std::vector<FeatureId> features;
    std::vector<PlacedCap> caps;  ///< by Reach::u0
  };
  const std::vector<PlacedCap>& on(PlaneId plane);
  [[nodiscard]] Reach cap_of(FeatureId id, PlaneId number) const;
  [[nodiscard]] bool is_cut_off_there(const Feature& feature, const Plane& plane,
                                      const Reach& reach) const;
  /// One of those with a cap within the rectangle, asked from left to right, passes the test.
  template <class Test>
  bool any_within(PlaneId plane, const Reach& reach, Test test);

  const Segmentation& segmentation_;
  const Tolerances& tolerances_;
  Work& work_;
  std::vector<OfPlane> planes_;
};

/// True if each ring of a solid's facets is filled by a feature: then add_ring_features has nothing
/// to add. So it is for nearly all solids, and it is known without a look at the input polygons.
bool are_all_rings_filled(const Solid& solid, FeatureIndex& caps, const Tolerances& tolerances);

}  // namespace oriel::detail
