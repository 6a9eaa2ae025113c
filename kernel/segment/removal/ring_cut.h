#pragma once

#include "kernel/segment/cuts/carve.h"

#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// Finds cuts of parts that leave nothing but a ring in one facet, as a window leaves in its wall,
/// without a section: what hangs on the ring is flooded, so the cost is the part's size. While
/// parts come off a body one after the other nothing has to be made anew.
class RingCuts {
 public:
  /// For this body, and for what it becomes by cuts.
  explicit RingCuts(const Boundary& body);

  /// Where find_feature_cut() is asked for the same, with all regions: the caps that it finds. One
  /// of the facets of the solid that `sources` name has to be in the part, at its ring. Nothing if
  /// only a section can tell: the part is met in more than a ring of edges, or anything else of the
  /// body may be inside it.
  std::optional<std::vector<CutCap>> find(const Boundary& body, int plane, int direction,
                                          bool is_material, Vec3 point,
                                          std::span<const FacetId> sources);

 private:
  /// A point of the body as it was, by its place on the line of axis_.
  struct PlacedPoint {
    double along;
    PointId point;
  };

  [[nodiscard]] bool has_others_inside(const Boundary& body, const Box& box);
  [[nodiscard]] bool is_living(const Boundary& body, PointId point) const;

  IndexedVector<FacetId, BodyFacetId> facet_of_source_;
  int axis_ = 0;                     ///< the longest of the body's box
  std::vector<PlacedPoint> placed_;  ///< ascending
  /// Half-edges of the body as it was, by where they begin: those of point p from first_[p] on.
  IndexedVector<PointId, int> first_;
  std::vector<EdgeId> leaving_;
  EdgeId next_fresh_;          ///< from here on half-edges were not looked at
  std::vector<EdgeId> fresh_;  ///< those that cuts made
};

}  // namespace oriel::detail
